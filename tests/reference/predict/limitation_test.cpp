// What counters would read without a limitation, against casters counted one by one between each
// point and the light, in double: no tree, no silhouettes, no volumes.
#include "reference/predict/limitation.h"
#include "reference/predict/prediction.h"
#include "scenes/camera.h"
#include "scenes/load/catalog.h"
#include "scenes/mesh/extrusion.h"
#include "scenes/plan/beam.h"
#include "scenes/plan/plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <glm/geometric.hpp>
#include <memory>
#include <string>
#include <vector>

namespace shadowproof {
namespace {

/// Which triangles are flipped: those averted from the light but of the glass, the one shell that
/// holds it, or all of that, or both.
enum class Flipped : std::uint8_t { none, averted, glass, glass_and_averted };

/// Where the line from `point` to `to` (w = 0: in its direction) meets a triangle's plane inside
/// the triangle, as a parameter; negative where it does not.
double meets(const TriangleCorners& t, const glm::dvec3& point, const glm::dvec3& along) {
    const glm::dvec3 ab = t[1] - t[0];
    const glm::dvec3 ac = t[2] - t[0];
    const glm::dvec3 normal = glm::cross(ab, ac);
    const double det = -glm::dot(normal, along);
    const glm::dvec3 across = glm::cross(point - t[0], along);
    const double u = glm::dot(ac, across) / det;
    const double v = -glm::dot(ab, across) / det;
    return u >= 0 && v >= 0 && u + v <= 1 ? glm::dot(normal, point - t[0]) / det : -1;
}

/// Counts casters' triangles that face the light, once some are flipped.
class Casters {
public:
    Casters(const Scene& scene, Flipped flipped)
        : scene_(scene), light_(chosen_light(scene).position) {
        const std::vector<std::uint8_t> casts = casting_triangles(scene);
        for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
            const TriangleCorners t = corners_of(scene, i);
            const bool faces = glm::dot(glm::cross(t[1] - t[0], t[2] - t[0]), light_ - t[0]) > 0;
            const bool glass = scene.meshes[mesh_of(scene, i)].name == "glass";
            const bool takes_glass =
                flipped == Flipped::glass || flipped == Flipped::glass_and_averted;
            const bool takes_averted =
                flipped == Flipped::averted || flipped == Flipped::glass_and_averted;
            const bool counts = glass ? faces != takes_glass : faces || takes_averted;
            if (casts[i] != 0 && counts) triangles_.push_back(i);
        }
    }

    bool have(std::uint32_t triangle) const {
        return std::ranges::find(triangles_, triangle) != triangles_.end();
    }
    /// Between a point and the light, without one triangle.
    int before(const glm::dvec3& point, std::uint32_t skip = no_triangle) const {
        return count(
            [&](const TriangleCorners& t) {
                const double at = meets(t, point, light_ - point);
                return at > 0 && at < 1;
            },
            skip);
    }
    /// Between the light and the end of a direction.
    int at_infinity(const glm::dvec3& direction) const {
        return count([&](const TriangleCorners& t) { return meets(t, light_, direction) > 0; },
                     no_triangle);
    }

private:
    const Scene& scene_;
    glm::dvec3 light_;
    std::vector<std::uint32_t> triangles_;

    template <class Holds>
    int count(const Holds& holds, std::uint32_t skip) const {
        int found = 0;
        for (const std::uint32_t triangle : triangles_)
            found += triangle != skip && holds(corners_of(scene_, triangle)) ? 1 : 0;
        return found;
    }
};

/// Shadow depths of one pixel.
struct Depths {
    int eye = 0;
    int near = 0;
    int surface = 0;
    int far = 0;
    int infinity = 0;
};

struct Case {
    std::string scene;
    std::function<CountingModel(const Scene&)> technique;
    Limitations lifted;
    Flipped flipped = Flipped::none;
    std::function<int(const Depths&)> expected;
};

DepthModel finite(const Scene& scene) {
    return {.near = scene.camera.near, .far = finite_far(scene)};
}
DepthModel infinite(const Scene& scene) {
    return {.projection = DepthModel::Projection::infinite, .near = scene.camera.near};
}
CountingModel zpass(const Scene& scene) {
    return {{.test = Counting::Test::depth_pass, .dark_cap = false}, finite(scene)};
}
CountingModel zpass_eye_count(const Scene& scene) {
    CountingModel model = zpass(scene);
    model.counting.start = Counting::Start::eye;
    return model;
}
CountingModel zfail(const Scene& scene) {
    return {{.dark_cap = false}, finite(scene)};
}
CountingModel robust(const Scene& scene) {
    return {{}, infinite(scene)};
}
CountingModel no_dark_cap(const Scene& scene) {
    return {{.dark_cap = false}, infinite(scene)};
}
CountingModel no_light_cap(const Scene& scene) {
    return {{.light_cap = false}, infinite(scene)};
}
CountingModel saturating(const Scene& scene) {
    return {{.operation = Counting::Operation::saturate}, infinite(scene)};
}
CountingModel inverting(const Scene& scene) {
    CountingModel model = zpass(scene);
    model.counting.operation = Counting::Operation::invert;
    return model;
}
CountingModel truncated(const Scene& scene) {
    return {{.extrusion = finite_extrusion(scene)}, infinite(scene)};
}
CountingModel filling(const Scene& scene) {
    return {{.holes_filled = true}, infinite(scene)};
}

using L = Limitation;
int in_front(const Depths& d) {
    return d.surface - d.near;
}
int from_eye(const Depths& d) {
    return d.surface - d.eye;
}
int at_surface(const Depths& d) {
    return d.surface;
}
int before_far(const Depths& d) {
    return d.surface - d.far;
}

std::vector<Case> cases() {
    const auto eye_added = [](const Depths& d) { return d.surface - d.near + d.eye; };
    const auto left_open = [](const Depths& d) { return d.surface - d.infinity; };
    std::vector<Case> all;
    for (const char* scene : {"near_plane", "eye_inside", "near_cap_some"}) {
        all.push_back({scene, zpass, {}, {}, in_front});
        all.push_back({scene, zpass, L::near_clip, {}, from_eye});
        all.push_back({scene, zpass, L::eye_start, {}, eye_added});
        all.push_back({scene, zpass, L::near_clip | L::eye_start, {}, at_surface});
        all.push_back({scene, zpass_eye_count, {}, {}, eye_added});
        all.push_back({scene, zpass_eye_count, L::near_clip, {}, at_surface});
        all.push_back({scene, inverting, L::near_clip | L::parity, {}, from_eye});
    }
    for (const char* scene : {"far_plane", "far_cut"}) {
        all.push_back({scene, zfail, {}, {}, before_far});
        all.push_back({scene, zfail, L::far_clip, {}, at_surface});
        all.push_back({scene, no_dark_cap, {}, {}, left_open});
        all.push_back({scene, no_dark_cap, L::caps, {}, at_surface});
    }
    for (const char* scene : {"ordinary", "eye_inside"}) {
        all.push_back({scene, truncated, L::extrusion, {}, at_surface});
        all.push_back({scene, no_light_cap, L::caps, {}, at_surface});
        all.push_back({scene, saturating, L::counter, {}, at_surface});
    }
    for (const char* scene : {"open_lid", "inverted", "ordinary"}) {
        all.push_back({scene, robust, {}, {}, at_surface});
        all.push_back({scene, robust, L::open_mesh, Flipped::averted, at_surface});
        all.push_back({scene, zpass, L::open_mesh, Flipped::averted, in_front});
        all.push_back({scene, filling, L::open_mesh, Flipped::averted, at_surface});
        all.push_back({scene, no_light_cap, L::open_mesh | L::caps, Flipped::averted, at_surface});
    }
    all.push_back({"light_inside", robust, {}, {}, at_surface});
    all.push_back({"light_inside", robust, L::light_inside, Flipped::glass, at_surface});
    all.push_back({"light_inside", robust, L::open_mesh, Flipped::averted, at_surface});
    all.push_back({"light_inside", robust, L::open_mesh | L::light_inside,
                   Flipped::glass_and_averted, at_surface});
    all.push_back({"light_inside", zfail, L::light_inside, Flipped::glass, before_far});
    return all;
}

struct Traced {
    Scene scene;
    Tracer tracer;
    Silhouette silhouette;
    GroundTruth truth;
    ShadowDepths depths;
    VolumeStore volumes;

    explicit Traced(const std::string& name)
        : scene(
              load_scene(name, {.camera = {}, .light = {}, .time = 0, .width = 24, .height = 24})),
          tracer(scene), silhouette(tracer), truth(trace(tracer)),
          depths(count_shadow_depths(tracer, truth, finite_far(scene))),
          volumes(tracer, silhouette, truth, depths) {}
};

TEST(Limitation, counts_without_it_are_those_of_casters_counted_one_by_one) {
    std::unique_ptr<Traced> traced;
    for (const Case& each : cases()) {
        if (!traced || traced->scene.name != each.scene)
            traced = std::make_unique<Traced>(each.scene);
        const Scene& scene = traced->scene;
        const Camera& camera = scene.camera;
        const CountingModel model = each.technique(scene);
        SCOPED_TRACE(each.scene + " " + std::to_string(each.lifted.bits()));
        const Prediction prediction(traced->volumes, model.counting, model.depth_model);
        EXPECT_TRUE(prediction.limitations().contains(each.lifted));
        const Casters casters(scene, each.flipped);
        int wrong = 0;
        int wrong_on_rays = 0;
        int seen = 0;
        for (int y = 0; y < camera.height; ++y)
            for (int x = 0; x < camera.width; ++x) {
                const std::uint32_t triangle = traced->truth.triangle.at(x, y);
                if (triangle == no_triangle) continue;
                ++seen;
                const glm::dvec3 ray = line_of_sight(camera, x + 0.5, y + 0.5);
                const double depth = traced->truth.depth.at(x, y);
                const auto at = [&](double t) { return camera.eye + t * ray; };
                // Just before the surface: a back lies between that and the light.
                const bool behind_itself =
                    casters.have(triangle) && !sides_of(traced->tracer, triangle).faces_light();
                const Depths depths{casters.before(camera.eye), casters.before(at(camera.near)),
                                    casters.before(at(depth), triangle) + (behind_itself ? 1 : 0),
                                    casters.before(at(finite_far(scene))),
                                    casters.at_infinity(ray)};
                const int expected = each.expected(depths);
                wrong += prediction.count_without(each.lifted, x, y) != expected ? 1 : 0;
                const SurfaceRay surface{ray, depth, triangle,
                                         corner_lines(camera, x, y, x + 1, y + 1)};
                wrong_on_rays += prediction.count_without(each.lifted, surface) != expected;
            }
        EXPECT_GT(seen, 100);
        EXPECT_EQ(wrong, 0);
        EXPECT_EQ(wrong_on_rays, 0);
    }
}

TEST(Limitation, each_technique_has_its_own) {
    const Scene scene = load_scene("ordinary", {});
    const Limitations all = L::open_mesh | L::light_inside;
    EXPECT_EQ(limitations_of(zpass(scene)), all | L::near_clip | L::eye_start | L::counter);
    EXPECT_EQ(limitations_of(zpass_eye_count(scene)), all | L::near_clip | L::counter);
    EXPECT_EQ(limitations_of(zfail(scene)), all | L::far_clip | L::counter);
    EXPECT_EQ(limitations_of(no_dark_cap(scene)), all | L::caps | L::counter);
    EXPECT_EQ(limitations_of(inverting(scene)), all | L::near_clip | L::eye_start | L::parity);
    EXPECT_EQ(limitations_of(truncated(scene)), all | L::extrusion | L::counter);
    CountingModel flipping = robust(scene);
    flipping.counting.flips.around_light = true;
    EXPECT_EQ(limitations_of(flipping), L::open_mesh | L::counter);
}

TEST(Limitation, without_all_of_them_a_technique_has_none_but_that_of_soups) {
    const Scene scene = load_scene("ordinary", {});
    for (const auto& technique : {zpass, zpass_eye_count, zfail, no_dark_cap, no_light_cap,
                                  saturating, inverting, truncated}) {
        const CountingModel model = technique(scene);
        const CountingModel lifted = without(model, limitations_of(model));
        EXPECT_EQ(lifted.counting.bits, 32);
        EXPECT_EQ(lifted.counting.operation, Counting::Operation::wrap);
        EXPECT_TRUE(lifted.counting.light_cap);
        EXPECT_TRUE(lifted.counting.flips.around_light);
    }
}

} // namespace
} // namespace shadowproof
