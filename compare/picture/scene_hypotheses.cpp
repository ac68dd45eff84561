#include "compare/picture/hypotheses.h"
#include "reference/predict/whole_casters.h"
#include "scenes/camera.h"
#include "scenes/surface/alpha_mask.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

namespace shadowproof {

namespace {

Predict truth_without(const Trial& trial, std::function<Scene()> make) {
    return truth_of(std::move(make), trial.traced().tracer().threads());
}

/// Whether a pixel sees a side of the mesh that faces the light; if none does, a missing mesh looks
/// like one without a shadow.
bool is_seen(const Trial& trial, std::size_t mesh) {
    const Image<std::uint32_t>& seen = trial.truth().triangle;
    for (std::size_t i = 0; i < seen.pixels.size(); ++i)
        if (seen.pixels[i] != no_triangle && mesh_of(trial.scene(), seen.pixels[i]) == mesh &&
            faces_light(trial.traced(), i))
            return true;
    return false;
}

/// The truth without the mesh. In its place there is something else, whose colours are not the
/// mesh's: no pixel there can be right.
Predict with_mesh_missing(const Trial& trial, std::size_t mesh) {
    const Scene& scene = trial.scene();
    const Predict without = truth_without(trial, [&scene, mesh] {
        return kept_by(scene,
                       [&](std::uint32_t triangle) { return mesh_of(scene, triangle) != mesh; });
    });
    return [&scene, &seen = trial.truth().triangle, mesh, without](std::span<const Patch> patches,
                                                                   Image<Visibility>& picture) {
        without(patches, picture);
        for (const Patch& patch : patches)
            for_each_pixel(patch, [&](int x, int y) {
                const std::uint32_t triangle = seen.at(x, y);
                if (triangle != no_triangle && mesh_of(scene, triangle) == mesh)
                    picture.at(x, y) = Visibility::background;
            });
    };
}

Predict with_light_moved(const Trial& trial, const glm::dvec3& by) {
    return truth_without(trial, [&scene = trial.scene(), by] {
        Scene moved = scene;
        Light& light = moved.lights[moved.light];
        if (light.kind == Light::Kind::directional)
            light.direction = glm::normalize(light.direction + by);
        else
            light.position += by;
        return moved;
    });
}

struct LightMove {
    glm::dvec3 by{0, 0, 0};
    std::int64_t score = 0;
};

/// The best of all steps along the axes, again and again; steps halve where none is better.
LightMove climbed(Trial& trial, const std::array<glm::dvec3, 3>& axes, double step, double least) {
    constexpr int rounds = 16; // of six predictions
    LightMove best;
    for (int round = 0; round < rounds && step >= least; ++round) {
        const LightMove from = best;
        for (const glm::dvec3& axis : axes)
            for (const double sign : {-1.0, 1.0}) {
                const glm::dvec3 by = from.by + sign * step * axis;
                const std::int64_t score = trial.fit(with_light_moved(trial, by)).score();
                if (score > best.score) best = {by, score};
            }
        if (best.score == from.score) step /= 2;
    }
    return best;
}

} // namespace

void try_operations(Trial& trial) {
    const GroundTruth& truth = trial.truth();
    trial.consider("no_shadow", {}, "no shadow is drawn",
                   changed(trial.traced(), [&truth](std::size_t i, Visibility) {
                       return in_cone(truth, i) ? Visibility::lit : Visibility::shadowed;
                   }));
    trial.consider("inverted", {}, "light and shadow are exchanged",
                   changed(trial.traced(), [](std::size_t, Visibility was) {
                       return was == Visibility::lit ? Visibility::shadowed : Visibility::lit;
                   }));
}

void try_lights(Trial& trial) {
    const Scene& scene = trial.scene();
    for (std::size_t light = 0; light < scene.lights.size(); ++light) {
        if (light == scene.light) continue;
        trial.consider(
            "other_light", {{"light", static_cast<double>(light)}},
            fmt::format("the shadows are those of light {} ({})", light, scene.lights[light].name),
            truth_without(trial, [&scene, light] {
                Scene other = scene;
                other.light = light;
                return other;
            }));
    }
}

/// One mesh after the other; each takes two traces of the sample.
void try_meshes(Trial& trial) {
    constexpr std::size_t most_meshes = 24;
    const Scene& scene = trial.scene();
    const GroundTruth& truth = trial.truth();
    for (std::size_t m = 0; m < std::min(scene.meshes.size(), most_meshes); ++m) {
        const Mesh& mesh = scene.meshes[m];
        const Parameters number{{"mesh", static_cast<double>(m)}};
        if (mesh.receives)
            trial.consider(
                "receiver_missing", number, mesh.name + " shows no shadows",
                changed(trial.traced(), [&scene, &truth, m](std::size_t i, Visibility was) {
                    const bool own = mesh_of(scene, truth.triangle.pixels[i]) == m;
                    return own && in_cone(truth, i) ? Visibility::lit : was;
                }));
        if (scene.meshes.size() < 2) continue;
        if (is_seen(trial, m))
            trial.consider("mesh_missing", number, mesh.name + " is not drawn",
                           with_mesh_missing(trial, m));
        if (mesh.casts)
            trial.consider("caster_missing", number, mesh.name + " casts no shadow",
                           truth_without(trial, [&scene, m] {
                               Scene without = scene;
                               without.meshes[m].casts = false;
                               return without;
                           }));
    }
}

namespace {

/// Pixels whose meshes, of which one is seen with masks and one without, are not the same.
std::shared_ptr<const Image<std::uint8_t>> behind_holes(const Trial& trial, const Scene& whole) {
    const Image<std::uint32_t> seen =
        trace(Tracer(whole, trial.traced().tracer().threads())).triangle;
    const Image<std::uint32_t>& own = trial.truth().triangle;
    const auto mesh = [&](std::uint32_t triangle) {
        return triangle == no_triangle ? no_triangle : mesh_of(whole, triangle);
    };
    auto behind = std::make_shared<Image<std::uint8_t>>(own.width, own.height);
    for (std::size_t i = 0; i < behind->pixels.size(); ++i)
        behind->pixels[i] = mesh(seen.pixels[i]) != mesh(own.pixels[i]) ? 1 : 0;
    return behind;
}

/// The truth of the scene without masks. In a hole something else is drawn than what its light and
/// shadow are read by: there the picture may show either.
Predict without_holes(const Trial& trial) {
    const Scene whole = without_masks(trial.scene());
    const auto behind = behind_holes(trial, whole);
    const Predict truth = truth_without(trial, [whole] { return whole; });
    return [truth, behind, &claim = trial.frame().claim](std::span<const Patch> patches,
                                                         Image<Visibility>& picture) {
        truth(patches, picture);
        for (const Patch& patch : patches)
            for_each_pixel(patch, [&](int x, int y) {
                if (behind->at(x, y) != 0) picture.at(x, y) = claim.at(x, y);
            });
    };
}

} // namespace

void try_masks(Trial& trial) {
    if (!has_masks(trial.scene())) return;
    const auto whole =
        std::make_shared<const Image<Visibility>>(under_whole_casters(trial.traced().tracer()));
    trial.consider(
        "alpha_ignored", {{"surfaces", 0}},
        "casters throw shadows as if their alpha masks left nothing out",
        changed(trial.traced(), [whole](std::size_t i, Visibility) { return whole->pixels[i]; }));
    trial.consider("alpha_ignored", {{"surfaces", 1}},
                   "alpha masks leave nothing out, of surfaces and of casters",
                   without_holes(trial));
}

void try_one_sided(Trial& trial) {
    const Scene& scene = trial.scene();
    const Tracer& tracer = trial.traced().tracer();
    for (const bool fronts : {true, false})
        trial.consider("one_sided_casters", {{"front", fronts ? 1.0 : 0.0}},
                       fmt::format("only triangles whose {} is towards the light throw shadows",
                                   fronts ? "front" : "back"),
                       truth_without(trial, [&scene, &tracer, fronts] {
                           return cast_by(scene, [&](std::uint32_t triangle) {
                               const TriangleSides sides = sides_of(tracer, triangle);
                               return fronts ? sides.front_to_light : sides.back_to_light;
                           });
                       }));
}

/// Steps across the way to what is seen, and along it: across, shadows move; towards it they only
/// grow. The first are a tenth of the light's distance, or of its direction where it is
/// directional; and a hundredth, from where a small move is not taken for a larger one along the
/// way.
void try_moved_light(Trial& trial) {
    const Scene& scene = trial.scene();
    const Light& light = chosen_light(scene);
    const Image<double>& depths = trial.truth().depth;
    const double depth =
        std::min(depths.at(depths.width / 2, depths.height / 2), trial.traced().far());
    const glm::dvec3 point = point_on(scene.camera, eye_line(scene.camera), depth);
    const bool directional = light.kind == Light::Kind::directional;
    const glm::dvec3 way = directional ? light.direction : point - light.position;
    if (!(glm::length(way) > 0)) return;
    const glm::dvec3 towards = glm::normalize(way);
    const glm::dvec3 hint = std::abs(towards.y) < 0.5 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 across = glm::normalize(glm::cross(towards, hint));
    const std::array<glm::dvec3, 3> axes{across, glm::cross(towards, across), towards};
    constexpr double finest = 2e-4; // moves shadows by less than most pixels
    LightMove best;
    for (const double share : {0.1, 0.01}) {
        const LightMove found =
            climbed(trial, axes, share * glm::length(way), finest * glm::length(way));
        if (found.score > best.score) best = found;
    }
    const glm::dvec3& by = best.by;
    if (best.score > 0)
        trial.consider(
            "light_moved", {{"x", by.x}, {"y", by.y}, {"z", by.z}},
            fmt::format("the light is moved by ({:.3g}, {:.3g}, {:.3g})", by.x, by.y, by.z),
            with_light_moved(trial, by));
}

} // namespace shadowproof
