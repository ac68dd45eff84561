// A surface in the near or the far plane: whether floats see it there is the driver's, and either
// is explained. Where it lies a little inside, it is seen.
#include "compare/verdict.h"
#include "tests/compare/traced_scene.h"
#include "tests/raster/small_scenes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace shadowproof::tests {
namespace {

enum class Side : std::uint8_t { near_plane, far_plane };
struct Case {
    Projection projection;
    Side side;
    double turn; ///< of all, about the vertical
};

/// A floor, a box over it, and a shield that faces the eye in the near or the far plane, or so far
/// beyond the near plane or before the far one. Turned, no float of it is exact.
Scene with_shield(const Case& tested, double beyond = 0, double near = 0.5) {
    const auto& [projection, side, turn] = tested;
    Scene scene = box_over_floor();
    scene.materials.front().double_sided = true;
    scene.lights.front().position = {3, 8, 2};
    const double depth = side == Side::near_plane ? near : 14;
    const double z = 8 - depth;
    add_rectangle(scene, glm::vec3(-2, 1, z), glm::vec3(0.5, 1, z), glm::vec3(0.5, 3, z),
                  glm::vec3(-2, 3, z));
    Camera& camera = scene.camera;
    camera.width = 60;
    camera.height = 40;
    camera.projection = projection;
    camera.half_height = projection == Projection::orthographic ? 3 : 0.7;
    camera.eye = {0, 2, 8};
    camera.right = {1, 0, 0};
    camera.up = {0, 1, 0};
    camera.forward = {0, 0, -1};
    (side == Side::near_plane ? camera.near : camera.far) =
        depth + (side == Side::near_plane ? -beyond : beyond);
    if (side == Side::far_plane) camera.near = 1;
    const auto turned = [turn = turn](const glm::dvec3& p) {
        return glm::dvec3(std::cos(turn) * p.x + std::sin(turn) * p.z, p.y,
                          std::cos(turn) * p.z - std::sin(turn) * p.x);
    };
    for (glm::vec3& position : scene.positions) position = glm::vec3(turned(position));
    camera.eye = turned(camera.eye);
    camera.right = turned(camera.right);
    camera.forward = turned(camera.forward);
    scene.lights.front().position = turned(scene.lights.front().position);
    return scene;
}

bool is_explained(const Comparison& comparison) {
    return comparison.summary.unexplained.empty() && comparison.evidence.unexplained == 0 &&
           pixels_of(comparison, Cause::unexplained) == 0 && comparison.too_near == 0;
}

void expect_all_explained(const TracedScene& traced) {
    Gpu gpu(GlPlatform::osmesa);
    for (const Technique& technique : all_techniques()) {
        if (!can_draw(technique, traced.scene)) continue;
        SCOPED_TRACE(technique.name);
        const Frame frame = render(technique, traced.scene, traced.plan, gpu);
        const Comparison comparison = compared(traced, frame);
        EXPECT_TRUE(is_explained(comparison)) << comparison.summary.words;
    }
}

class CutSurface : public testing::TestWithParam<Case> {};
std::vector<Case> cases() {
    std::vector<Case> all;
    for (const Projection projection : {Projection::perspective, Projection::orthographic})
        for (const Side side : {Side::near_plane, Side::far_plane})
            for (const double turn : {0.0, 0.3, 2.9}) all.push_back({projection, side, turn});
    return all;
}

std::string name_of_case(const testing::TestParamInfo<Case>& tested) {
    const auto& [projection, side, turn] = tested.param;
    return fmt::format("{}_{}_turned_{:.0f}",
                       projection == Projection::perspective ? "perspective" : "parallel",
                       side == Side::near_plane ? "near" : "far", 10 * turn);
}

INSTANTIATE_TEST_SUITE_P(In, CutSurface, testing::ValuesIn(cases()), name_of_case);

TEST_P(CutSurface, is_explained_whether_or_not_it_is_seen) {
    for (const double beyond : {0.0, 1e-8, -1e-8})
        for (const double near : {0.5, 0.6, 0.0}) {
            if (near != 0.5 && GetParam().side == Side::far_plane) continue;
            if (near <= 0 && (GetParam().projection == Projection::perspective || beyond > 0))
                continue;
            SCOPED_TRACE(fmt::format("{} beyond, near {}", beyond, near));
            expect_all_explained(TracedScene(with_shield(GetParam(), beyond, near)));
        }
}

/// Far from the origin, with a near plane so near that the far one, which cuts the floor, lies
/// where the floats of the projection have it.
TEST(CutFloor, is_explained_far_from_the_origin) {
    for (const double away : {1e2, 1e3, 1e4}) {
        Scene scene = with_shield({Projection::perspective, Side::far_plane, 0.3});
        for (glm::vec3& position : scene.positions) position += glm::vec3(float(away), 0, 0);
        scene.camera.eye.x += away;
        scene.lights.front().position.x += away;
        scene.camera.near = away > 5e3 ? 1e-2 : 1e-4;
        expect_all_explained(TracedScene(std::move(scene)));
    }
}

/// The shield is cut in one picture and not in the other.
TEST_P(CutSurface, that_is_lost_or_seen_beyond_what_floats_may_do_is_caught) {
    for (const char* technique : {"zpass", "zfail_reversed", "zfail_clamp", "cube_map_six_pass"}) {
        SCOPED_TRACE(technique);
        Gpu gpu(GlPlatform::osmesa);
        const auto is_explained_as = [&](double truly, double drawn) {
            const TracedScene traced(with_shield(GetParam(), truly));
            const TracedScene other(with_shield(GetParam(), drawn));
            return is_explained(
                compared(traced, render(*find_technique(technique), other.scene, other.plan, gpu)));
        };
        EXPECT_TRUE(is_explained_as(1e-4, 1e-4));
        EXPECT_FALSE(is_explained_as(1e-4, -1e-4)); // lost
        EXPECT_FALSE(is_explained_as(-1e-4, 1e-4)); // seen
    }
}

/// What lies behind the shield is seen where that is lost, and nothing else.
TEST_P(CutSurface, does_not_excuse_other_claims) {
    const TracedScene traced(with_shield(GetParam()));
    Gpu gpu(GlPlatform::osmesa);
    const Frame frame =
        render(*find_technique("cube_map_six_pass"), traced.scene, traced.plan, gpu);
    ASSERT_TRUE(is_explained(compared(traced, frame)));
    for (const Visibility from : {Visibility::lit, Visibility::shadowed}) {
        Frame wrong = frame;
        int changed = 0;
        for (int y = 10; y < 30; ++y)
            for (int x = 20; x < 40; ++x)
                if (frame.claim.at(x, y) == from) {
                    wrong.claim.at(x, y) =
                        from == Visibility::lit ? Visibility::shadowed : Visibility::lit;
                    ++changed;
                }
        EXPECT_EQ(is_explained(compared(traced, wrong)), changed == 0);
    }
}

} // namespace
} // namespace shadowproof::tests
