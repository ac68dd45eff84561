// Rays from anywhere: geometry whose answer is known by hand, and candidates against all triangles.
#include "reference/trace/any_rays.h"
#include "reference/trace/lanes.h"
#include "reference/trace/view.h"
#include "reference/walk/instruction_set.h"
#include "scenes/error.h"
#include "scenes/load/catalog.h"
#include "tests/dice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <set>

namespace shadowproof {
namespace {

const Corners triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

AnyRay down(double x, double y) {
    return {{x, y, 1}, {0, 0, -1}};
}

TEST(AnyRays, a_triangle_is_closed_and_the_limits_are_open_and_closed) {
    EXPECT_TRUE(meets(down(0.25, 0.25), triangle));
    EXPECT_TRUE(meets(down(0.5, 0.5), triangle)) << "on an edge";
    EXPECT_TRUE(meets(down(0, 0), triangle)) << "on a corner";
    EXPECT_FALSE(meets(down(std::nextafter(0.5, 1), 0.5), triangle));
    EXPECT_FALSE(meets(down(-1e-300, 0.5), triangle));
    EXPECT_FALSE(meets({{0.25, 0.25, 1}, {0, 0, 1}}, triangle)) << "behind";
    EXPECT_FALSE(meets({{0.25, 0.25, 1}, {0, 0, -1}, 1}, triangle)) << "t must exceed near";
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const double x : {0.25, 0.5}) // within, and on an edge
        EXPECT_TRUE(meets({{x, 0.5, -5000}, {0, 0, -1}, -infinity}, triangle)) << x;
    EXPECT_TRUE(meets({{0.25, 0.25, 1}, {0, 0, -1}, 0, 1}, triangle)) << "t may be far";
    EXPECT_FALSE(meets({{0.25, 0.25, 1}, {0, 0, -1}, 0, std::nextafter(1, 0)}, triangle));
}

TEST(AnyRays, a_ray_in_the_plane_meets_nothing) {
    EXPECT_FALSE(meets({{-1, 0.25, 0}, {1, 0, 0}}, triangle));
    EXPECT_FALSE(meets({{-1, 0, 0}, {1, 0, 0}}, triangle)) << "along an edge";
    EXPECT_FALSE(meets(down(0.25, 0.25), {{0, 0, 0}, {1, 1, 0}, {0.5, 0.5, 0}})) << "no area";
}

TEST(AnyRays, the_nearer_plane_is_told) {
    const Corners further{{0, 0, -1e-300}, {1, 0, -1e-300}, {0, 1, -1e-300}};
    EXPECT_LT(order_along(down(0.25, 0.25), triangle, further), 0);
    EXPECT_GT(order_along(down(0.25, 0.25), further, triangle), 0);
    EXPECT_EQ(order_along(down(0.25, 0.25), triangle, triangle), 0);
}

/// Corners and rays on a coarse lattice touch edges and corners often; far from the origin their
/// differences round; tiny ones underflow.
void expect_certainties_to_be_so() {
    Dice dice(3);
    int through = 0;
    int beside = 0;
    int uncertain = 0;
    for (int i = 0; i < 4000; ++i) {
        constexpr std::array scales{1.0, 1e-200, 1e-160, 1e150, 1.0};
        const double scale = dice.one_of(scales);
        const double far_away = dice.one_in(2) ? 0 : scale * 0x1p50;
        const auto place = [&] {
            const auto step = [&] { return scale * (static_cast<double>(dice.below(9)) - 4); };
            return glm::dvec3(step() + far_away, step() / 3, step() * 0.7);
        };
        const Corners t{place(), place(), place()};
        AnyRays rays;
        for (int lane = 0; lane < packet_size; ++lane) {
            const glm::dvec3 from = place();
            rays.set(lane, {from, dice.one_in(3) ? t.a - from : place() - from, -1e300});
        }
        const LanesBeside sides = lanes_beside(rays, t);
        for (int lane = 0; lane < packet_size; ++lane) {
            const bool is_through = (sides.through >> lane & 1U) != 0;
            const bool is_beside = (sides.beside >> lane & 1U) != 0;
            through += is_through ? 1 : 0;
            beside += is_beside ? 1 : 0;
            uncertain += is_through || is_beside ? 0 : 1;
            const bool is_met = meets(rays.ray(lane), t);
            if (is_through) {
                EXPECT_TRUE(is_met) << i << " lane " << lane;
            }
            if (is_beside) {
                EXPECT_FALSE(is_met) << i << " lane " << lane;
            }
        }
    }
    EXPECT_GT(through, 500);
    EXPECT_GT(beside, 5000);
    EXPECT_GT(uncertain, 5000);
}

TEST(AnyRays, what_doubles_are_certain_of_is_so_with_every_instruction_set) {
    for (const char* set : {"sse2", "ssse3", "sse4", "avx2", "avx512"}) {
        SCOPED_TRACE(set);
        setenv("SHADOWPROOF_INSTRUCTION_SET", set, 1);
        try {
            choose_instruction_set();
            expect_certainties_to_be_so();
        } catch (const Error& error) {
            EXPECT_STRNE(set, "sse2") << error.what(); // the processor lacks another
        }
    }
    unsetenv("SHADOWPROOF_INSTRUCTION_SET");
    choose_instruction_set();
}

TEST(AnyRays, through_a_triangles_inside_are_certain_and_on_its_edge_are_not) {
    AnyRays one;
    one.set(0, down(0.25, 0.25));
    EXPECT_EQ(lanes_beside(one, triangle).through & 1U, 1U);
    one.set(0, down(0.5, 0.5));
    EXPECT_EQ(lanes_beside(one, triangle).through & 1U, 0U) << "on an edge";
    EXPECT_EQ(lanes_beside(one, triangle).beside & 1U, 0U) << "on an edge";
}

class Visited final : public NearbyTriangles {
public:
    std::array<std::set<std::uint32_t>, packet_size> triangles;
    void visit(AnyRays& /*rays*/, std::uint32_t index, std::uint32_t lanes) override {
        for (std::size_t l = 0; l < triangles.size(); ++l)
            if ((lanes >> l & 1U) != 0) triangles[l].insert(index);
    }
};

TEST(AnyRays, every_triangle_that_a_ray_meets_is_visited_and_most_others_are_not) {
    const Scene scene = load_scene("ordinary", {});
    const Tracer tracer(scene);
    Dice dice(7);
    std::size_t met = 0;
    std::size_t visited = 0;
    for (int packet = 0; packet < 8; ++packet) {
        AnyRays rays;
        std::array<AnyRay, packet_size> each;
        for (int lane = 0; lane < packet_size; ++lane) {
            const auto vector = [&] {
                return glm::dvec3(dice.between(-3, 3), dice.between(-1, 3), dice.between(-3, 3));
            };
            AnyRay& ray = each[static_cast<std::size_t>(lane)];
            ray.origin = vector();
            ray.direction = vector() - ray.origin;
            if (dice.one_in(4)) ray.direction[static_cast<int>(dice.below(3))] = 0;
            if (dice.one_in(4)) ray.far = 1;
            rays.set(lane, ray);
        }
        Visited found;
        find_nearby(tracer, 0x1p-21, rays, found);
        for (std::size_t l = 0; l < each.size(); ++l) {
            for (std::uint32_t i = 0; i < scene.triangles.size(); ++i)
                if (meets(each[l], corners(scene, i))) {
                    ++met;
                    EXPECT_TRUE(found.triangles[l].contains(i));
                }
            visited += found.triangles[l].size();
        }
    }
    EXPECT_GT(met, 100U);
    EXPECT_LT(visited, 8 * packet_size * scene.triangles.size() / 20);
}

/// The same questions as the truth asks of the camera's own rays.
TEST(AnyRays, from_the_eye_they_say_what_the_truth_says) {
    SceneRequest request;
    request.width = request.height = 32;
    for (const char* name : {"ordinary", "spot", "sun"}) {
        const Scene scene = load_scene(name, request);
        const Tracer tracer(scene);
        const GroundTruth truth = trace(tracer);
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 32; ++x) {
                const AnyRay ray{scene.camera.eye, line_of_sight(scene.camera, x + 0.5, y + 0.5)};
                const std::uint32_t seen = truth.triangle.at(x, y);
                if (seen == no_triangle) continue;
                bool lit = faces_light(tracer, seen) && within_cone(tracer, ray, seen);
                for (std::uint32_t i = 0; lit && i < scene.triangles.size(); ++i)
                    lit = !receives_shadows(tracer, seen) || !stands_between(tracer, ray, seen, i);
                EXPECT_EQ(lit, truth.visibility.at(x, y) == Visibility::lit)
                    << name << " " << x << "," << y;
            }
    }
}

} // namespace
} // namespace shadowproof
