#include "compare/picture/controls.h"

#include "compare/picture/light_sampling.h"
#include "scenes/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

namespace shadowproof {

namespace {

/// What the controls are sized by: the pixels in shadow that face the light.
struct ShadowedPixels {
    std::vector<std::size_t> pixels;
    double furthest = 0; ///< from the light
    double median = 0;   ///< the same, of half of them
};

ShadowedPixels shadowed_pixels(const TracedScene& traced) {
    const Image<Visibility>& truth = traced.truth().visibility;
    const glm::dvec3 light = chosen_light(traced.scene()).position;
    ShadowedPixels found;
    std::vector<double> distances;
    for (int y = 0; y < truth.height; ++y)
        for (int x = 0; x < truth.width; ++x) {
            const std::size_t i =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(truth.width) +
                static_cast<std::size_t>(x);
            if (truth.pixels[i] != Visibility::shadowed || !faces_light(traced, i) ||
                !in_cone(traced.truth(), i))
                continue;
            found.pixels.push_back(i);
            distances.push_back(glm::distance(seen_point(traced, x, y), light));
        }
    if (distances.empty()) return found;
    found.furthest = *std::max_element(distances.begin(), distances.end());
    const auto middle = distances.begin() + std::ssize(distances) / 2;
    std::nth_element(distances.begin(), middle, distances.end());
    found.median = *middle;
    return found;
}

void add_casters(const TracedScene& traced, std::vector<Control>& controls) {
    const Scene& scene = traced.scene();
    const int threads = traced.tracer().threads();
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        if (!scene.meshes[m].casts) continue;
        controls.push_back({"caster_missing", scene.meshes[m].name + " casts no shadow",
                            truth_of(
                                [&scene, m] {
                                    Scene without = scene;
                                    without.meshes[m].casts = false;
                                    return without;
                                },
                                threads)});
    }
}

void add_moved_lights(const TracedScene& traced, double distance, std::vector<Control>& controls) {
    const Scene& scene = traced.scene();
    for (const double share : {0.01, 0.02, 0.05})
        controls.push_back({"light_moved",
                            fmt::format("the light is moved by {:.0f} %", 100 * share),
                            truth_of(
                                [&scene, share, distance] {
                                    Scene moved = scene;
                                    Light& light = moved.lights[moved.light];
                                    const glm::dvec3 by = share * scene.camera.right;
                                    if (light.kind == Light::Kind::directional)
                                        light.direction = glm::normalize(light.direction + by);
                                    else
                                        light.position += distance * by;
                                    return moved;
                                },
                                traced.tracer().threads())});
}

/// The lowest-numbered triangle of those that shadow the middle one of the shadowed pixels.
void add_lost_triangle(const TracedScene& traced, const ShadowedPixels& shadowed,
                       std::vector<Control>& controls) {
    const Scene& scene = traced.scene();
    const std::size_t pixel = shadowed.pixels[shadowed.pixels.size() / 2];
    const auto width = static_cast<std::size_t>(scene.camera.width);
    const std::uint32_t lost = occluder_of(
        traced.tracer(), line_of_sight(scene.camera, static_cast<double>(pixel % width) + 0.5,
                                       static_cast<double>(pixel / width) + 0.5));
    if (lost == no_triangle) return;
    controls.push_back(
        {"triangle_missing",
         fmt::format("triangle {} of {} casts no shadow",
                     lost - scene.meshes[mesh_of(scene, lost)].first_triangle,
                     scene.meshes[mesh_of(scene, lost)].name),
         truth_of(
             [&scene, lost] {
                 return cast_by(scene, [lost](std::uint32_t triangle) { return triangle != lost; });
             },
             traced.tracer().threads())});
}

/// Each surface shows at a pixel what it truly shows at the next one to the left.
Predict shifted(const TracedScene& traced) {
    return changed(traced, [&traced](std::size_t pixel, Visibility was) {
        const GroundTruth& truth = traced.truth();
        if (pixel % static_cast<std::size_t>(truth.visibility.width) == 0) return was;
        const std::uint32_t next = truth.triangle.pixels[pixel - 1];
        const bool same =
            next != no_triangle &&
            mesh_of(traced.scene(), next) == mesh_of(traced.scene(), truth.triangle.pixels[pixel]);
        return same && faces_light(traced, pixel - 1) ? truth.visibility.pixels[pixel - 1] : was;
    });
}

Predict ended_at(const TracedScene& traced, double range) {
    return changed(traced, [&traced, range](std::size_t pixel, Visibility was) {
        const auto width = static_cast<std::size_t>(traced.truth().visibility.width);
        const glm::dvec3 point =
            seen_point(traced, static_cast<int>(pixel % width), static_cast<int>(pixel / width));
        const bool beyond = glm::distance(point, chosen_light(traced.scene()).position) > range;
        return beyond && in_cone(traced.truth(), pixel) ? Visibility::lit : was;
    });
}

} // namespace

std::vector<Control> controls_of(const TracedScene& traced) {
    std::vector<Control> controls;
    const ShadowedPixels shadowed = shadowed_pixels(traced);
    add_casters(traced, controls);
    add_moved_lights(traced, shadowed.median, controls);
    const Light::Kind kind = chosen_light(traced.scene()).kind;
    if (kind != Light::Kind::directional && shadowed.median > 0)
        controls.push_back(
            {"bias",
             fmt::format("shadow rays miss what is closer than {:.3g}", 0.01 * shadowed.median),
             lit_within(traced, {}, {.constant = 0.01 * shadowed.median})});
    if (kind != Light::Kind::directional && shadowed.furthest > 0)
        controls.push_back(
            {"range", fmt::format("shadows end {:.4g} from the light", 0.9 * shadowed.furthest),
             ended_at(traced, 0.9 * shadowed.furthest)});
    if (!shadowed.pixels.empty()) add_lost_triangle(traced, shadowed, controls);
    controls.push_back({"shadow_shifted", "shadows are shifted by a pixel", shifted(traced)});
    return controls;
}

FaultyFrame faulty_frame(const TracedScene& traced, const Frame& own, const Control& control) {
    const Image<Visibility>& truth = traced.truth().visibility;
    Image<Visibility> picture = truth;
    control.predict(all_patches(truth.width, truth.height), picture);
    FaultyFrame faulty;
    faulty.frame.family = own.family;
    faulty.frame.claim = truth;
    faulty.frame.pictured = own.pictured;
    PicturedShadows& shadows = *faulty.frame.pictured;
    for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
        const bool is_changed = picture.pixels[i] != truth.pixels[i] && faces_light(traced, i);
        faulty.changed += is_changed ? 1U : 0U;
        if (shadows.decided.pixels[i] == 0) continue;
        faulty.told += is_changed ? 1U : 0U;
        if (is_changed) faulty.frame.claim.pixels[i] = picture.pixels[i];
        shadows.lit_share.pixels[i] = faulty.frame.claim.pixels[i] == Visibility::lit ? 1.0F : 0.0F;
    }
    return faulty;
}

} // namespace shadowproof
