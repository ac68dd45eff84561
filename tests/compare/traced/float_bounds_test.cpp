// What Embree answers, held against the bounds of what its floats may answer: random rays at random
// triangles, most of them aimed where rounding decides.
#include "compare/traced/float_bounds.h"
#include "raster/traced/embree_world.h"
#include "tests/dice.h"
#include "tests/raster/small_scenes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof {
namespace {

/// Triangles of all shapes, some thousand times as long as wide, near the origin or far from it.
Scene random_triangles(Dice& dice, double away) {
    Scene scene = tests::empty_scene();
    const glm::dvec3 centre(away, -0.37 * away, 0.61 * away);
    const auto vector = [&](double size) {
        return size * glm::dvec3(dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1));
    };
    for (std::uint32_t i = 0; i < 40; ++i) {
        const glm::dvec3 a = centre + vector(4);
        const glm::dvec3 along = vector(3);
        const double width = std::pow(10, dice.between(-5, 0));
        for (const glm::dvec3& corner :
             {a, a + along, a + along * dice.between(0, 1) + vector(3) * width})
            scene.positions.emplace_back(corner);
        scene.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    // One that lies along the axes: its box has no thickness.
    scene.positions.emplace_back(centre);
    scene.positions.emplace_back(centre + glm::dvec3(3, 0, 0));
    scene.positions.emplace_back(centre + glm::dvec3(0, 0, 3));
    scene.triangles.emplace_back(120, 121, 122);
    scene.meshes = {{.name = "soup", .triangle_count = 41}};
    scene.materials[0].double_sided = true;
    scene.camera.eye = centre + glm::dvec3(0.1, 9, 0.2);
    return scene;
}

/// From somewhere towards a point on or near an edge of some triangle.
AnyRay ray_at_edge(const Scene& scene, Dice& dice) {
    const auto triangle = static_cast<std::uint32_t>(dice.below(scene.triangles.size()));
    const glm::dvec3 a = corner(scene, triangle, 0);
    const glm::dvec3 b = corner(scene, triangle, 1);
    const glm::dvec3 c = corner(scene, triangle, 2);
    double inwards = dice.one_in(3) ? dice.between(0, 1) : 0;
    if (dice.one_in(3)) inwards = dice.between(-1e-6, 1e-6);
    const glm::dvec3 target = glm::mix(glm::mix(a, b, dice.between(0, 1)), c, inwards);
    glm::vec3 from = corner(scene, triangle, 0);
    for (int axis = 0; axis < 3; ++axis) from[axis] += static_cast<float>(dice.between(-6, 6));
    if (dice.one_in(4)) from = target; // grazes, or starts on it
    glm::vec3 direction = glm::normalize(target - glm::dvec3(from) +
                                         (dice.one_in(4) ? b - a : glm::dvec3(0, 0, 0)) + 1e-9);
    if (dice.one_in(8)) direction[static_cast<int>(dice.below(3))] = 0;
    AnyRay ray{from, direction, dice.one_in(2) ? 0.0 : double{1e-3F}};
    if (dice.one_in(3)) ray.far = static_cast<float>(glm::distance(target, glm::dvec3(from)));
    return ray;
}

void set(FloatRays& rays, std::size_t lane, const AnyRay& ray) {
    const glm::vec3 origin(ray.origin);
    const glm::vec3 direction(ray.direction);
    rays.origin_x[lane] = origin.x;
    rays.origin_y[lane] = origin.y;
    rays.origin_z[lane] = origin.z;
    rays.direction_x[lane] = direction.x;
    rays.direction_y[lane] = direction.y;
    rays.direction_z[lane] = direction.z;
    rays.near[lane] = static_cast<float>(ray.near);
    rays.far[lane] = static_cast<float>(ray.far);
    rays.own[lane] = no_triangle;
    rays.valid[lane] = direction != glm::vec3(0, 0, 0) && ray.far > ray.near;
}

struct Tally {
    int certain = 0;
    int undecided = 0;
    int wrong = 0;   ///< within bounds, yet not the exact answer
    int refuted = 0; ///< beyond bounds
};

/// Of each ray the nearest triangle and any.
void hold_against(const Scene& scene, const Tracer& tracer, const EmbreeWorld& world,
                  const std::array<AnyRay, traced_packet>& rays, Tally& tally) {
    FloatRays nearest;
    for (std::size_t i = 0; i < traced_packet; ++i) set(nearest, i, rays[i]);
    FloatRays any = nearest;
    world.find_nearest(nearest);
    world.find_any(any);
    for (std::size_t i = 0; i < traced_packet; ++i) {
        if (!nearest.valid[i]) continue;
        const glm::dvec3 room = enlargement(tracer, traversal_share, rays[i].origin);
        bool some_always = false;
        bool some_perhaps = false;
        bool some_exactly = false;
        for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
            const FloatMeeting met = float_meeting(rays[i], corners(scene, t), room);
            some_always |= met.meeting == Meeting::always;
            some_perhaps |= met.meeting == Meeting::perhaps;
            const bool exactly = meets(rays[i], corners(scene, t));
            some_exactly |= exactly;
            // The exact answer is always within the bounds.
            tally.refuted += met.meeting == Meeting::always && !exactly;
            tally.refuted += met.meeting == Meeting::never && exactly;
            if (nearest.hit[i] == t)
                tally.refuted +=
                    met.meeting == Meeting::never || std::abs(nearest.far[i] - met.t) > met.t_error;
            if (any.hit[i] == t) tally.refuted += met.meeting == Meeting::never;
        }
        tally.certain += !some_perhaps;
        tally.undecided += some_perhaps;
        for (const std::uint32_t hit : {nearest.hit[i], any.hit[i]}) {
            tally.refuted += hit == no_triangle && some_always;
            tally.wrong += (hit != no_triangle) != some_exactly;
        }
    }
}

TEST(FloatBounds, embree_never_leaves_them) {
    Dice dice(20261123);
    Tally tally;
    for (int round = 0; round < 60; ++round) {
        const double away = round % 3 == 0 ? 0 : std::pow(10, dice.between(0, 6));
        const Scene scene = random_triangles(dice, away);
        const Tracer tracer(scene);
        const EmbreeWorld world(scene);
        for (int packet = 0; packet < 60; ++packet) {
            std::array<AnyRay, traced_packet> rays;
            for (AnyRay& ray : rays) ray = ray_at_edge(scene, dice);
            hold_against(scene, tracer, world, rays, tally);
        }
    }
    EXPECT_EQ(tally.refuted, 0);
    // The test sees both what bounds decide and what they leave to rounding, and Embree's errors.
    EXPECT_GT(tally.certain, 1000);
    EXPECT_GT(tally.undecided, 1000);
    EXPECT_GT(tally.wrong, 100);
}

TEST(FloatBounds, a_ray_through_the_middle_is_met_and_one_beside_it_is_not) {
    const Corners t{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const glm::dvec3 room(1e-6);
    const auto at = [&](double x, double y) {
        return float_meeting({{x, y, 2}, {0, 0, -1}}, t, room).meeting;
    };
    EXPECT_EQ(at(0.25, 0.25), Meeting::always);
    EXPECT_EQ(at(0.75, 0.75), Meeting::never);
    EXPECT_EQ(at(0.5, 0.5), Meeting::perhaps);
    EXPECT_EQ(at(-0.001, 0.5), Meeting::never);
    EXPECT_EQ(float_meeting({{0.25, 0.25, 2}, {0, 0, -1}, 3}, t, room).meeting, Meeting::never);
    EXPECT_EQ(float_meeting({{0.25, 0.25, 2}, {0, 0, -1}, 0, 1}, t, room).meeting, Meeting::never);
    EXPECT_EQ(float_meeting({{0.25, 0.25, 2}, {0, 0, -1}, 2}, t, room).meeting, Meeting::perhaps);
}

/// Embree compares all triangles of a leaf, whose box may be met where the triangle's own is not.
TEST(FloatBounds, a_triangle_in_the_rays_plane_may_be_met_beside_its_box_and_no_other_may) {
    const Corners t{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const auto towards = [&](double tilt) {
        return float_meeting({{-2, 0.25, tilt}, {1, 0, 0}, 0, 1}, t, glm::dvec3(1e-6)).meeting;
    };
    EXPECT_EQ(towards(0), Meeting::perhaps);
    EXPECT_EQ(float_meeting({{-2, 0.25, 0}, {1, 0, 0x1p-10}, 0, 1}, t, glm::dvec3(1e-6)).meeting,
              Meeting::never);
    // Beside the plane, by whatever the numbers tell from their own errors, it is not met.
    EXPECT_EQ(towards(0x1p-10), Meeting::never);
}

} // namespace
} // namespace shadowproof
