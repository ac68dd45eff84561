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
#include <vector>

namespace shadowproof {

namespace {

Predict truth_without(const Trial& trial, std::function<Scene()> make) {
    return truth_of(std::move(make), trial.traced().tracer().threads());
}

/// The pixels that see a side of a mesh which faces the light.
struct ShownMesh {
    std::uint64_t pixels = 0;
    std::uint64_t right = 0; ///< of these
};

ShownMesh shown_of(const Trial& trial, std::size_t mesh) {
    const Image<std::uint32_t>& seen = trial.truth().triangle;
    ShownMesh shown;
    for (int y = 0; y < seen.height; ++y)
        for (int x = 0; x < seen.width; ++x)
            if (seen.at(x, y) != no_triangle && mesh_of(trial.scene(), seen.at(x, y)) == mesh &&
                faces_light(trial.traced(), seen.index(x, y))) {
                ++shown.pixels;
                shown.right += trial.is_right(x, y) ? 1U : 0U;
            }
    return shown;
}

/// The truth without the mesh. In its place stands what is behind it, or a background as dark as
/// shadow; read by the mesh's colours or by what light adds to it, either may be taken for the
/// other, and so any pixel there may be wrong.
Predict with_mesh_missing(const Trial& trial, std::size_t mesh) {
    const Scene& scene = trial.scene();
    const Predict without = truth_without(trial, [&scene, mesh] {
        return kept_by(scene,
                       [&](std::uint32_t triangle) { return mesh_of(scene, triangle) != mesh; });
    });
    return [&trial, mesh, without](std::span<const Patch> patches, Image<Visibility>& picture) {
        without(patches, picture);
        for (const Patch& patch : patches)
            for_each_pixel(patch, [&](int x, int y) {
                const std::uint32_t triangle = trial.truth().triangle.at(x, y);
                if (triangle == no_triangle || mesh_of(trial.scene(), triangle) != mesh) return;
                Visibility& behind = picture.at(x, y);
                if (trial.is_wrong(x, y))
                    behind = trial.frame().claim.at(x, y);
                else if (behind == Visibility::background)
                    behind = Visibility::shadowed;
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

std::int64_t score_of(Trial& trial, const glm::dvec3& by) {
    return trial.fit(with_light_moved(trial, by)).score();
}

/// The unit vectors between two or three axes.
std::vector<glm::dvec3> diagonals(const std::array<glm::dvec3, 3>& axes) {
    std::vector<glm::dvec3> ways;
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z)
                if (std::abs(x) + std::abs(y) + std::abs(z) >= 2)
                    ways.push_back(glm::normalize(double(x) * axes[0] + double(y) * axes[1] +
                                                  double(z) * axes[2]));
    return ways;
}

/// Steps along one axis after the other, again and again, and as far again in the direction in
/// which they led (Hooke and Jeeves, "Direct search solution of numerical and statistical
/// problems", 1961); where none is better, between the axes; where none is better still, steps
/// halve.
LightMove climbed(Trial& trial, const std::array<glm::dvec3, 3>& axes, double step, double least) {
    constexpr int rounds = 20; // of seven predictions, and of twenty more before steps halve
    LightMove best;
    const auto look = [&](const glm::dvec3& by) {
        const std::int64_t score = score_of(trial, by);
        if (score > best.score) best = {by, score};
    };
    for (int round = 0; round < rounds && step >= least; ++round) {
        const LightMove from = best;
        for (const glm::dvec3& axis : axes) {
            const glm::dvec3 here = best.by;
            for (const double sign : {-1.0, 1.0}) look(here + sign * step * axis);
        }
        if (best.score == from.score)
            for (const glm::dvec3& way : diagonals(axes)) look(from.by + step * way);
        if (best.score == from.score)
            step /= 2;
        else
            look(best.by + (best.by - from.by));
    }
    return best;
}

/// The smallest move that fits no worse, by steps that halve where none leads to a smaller one.
LightMove contracted(Trial& trial, const std::array<glm::dvec3, 3>& axes, LightMove best,
                     double least) {
    for (double step = glm::length(best.by) / 2; step >= least;) {
        const LightMove from = best;
        for (const glm::dvec3& axis : axes)
            for (const double sign : {-1.0, 1.0}) {
                const glm::dvec3 by = from.by + sign * step * axis;
                if (glm::length(by) >= glm::length(best.by)) continue;
                const std::int64_t score = score_of(trial, by);
                if (score >= best.score) best = {by, score};
            }
        if (best.by == from.by) step /= 2;
    }
    return best;
}

/// The middle, along its way, of a smallest move and the largest that fits as well.
LightMove centred(Trial& trial, const LightMove& smallest) {
    constexpr int bisections = 8;
    double fits = 1;
    double fails = 2;
    while (fails < 64 && score_of(trial, fails * smallest.by) >= smallest.score) {
        fits = fails;
        fails *= 2;
    }
    for (int i = 0; i < bisections; ++i) {
        const double middle = (fits + fails) / 2;
        (score_of(trial, middle * smallest.by) >= smallest.score ? fits : fails) = middle;
    }
    const glm::dvec3 by = (1 + fits) / 2 * smallest.by;
    const std::int64_t score = score_of(trial, by);
    return score >= smallest.score ? LightMove{by, score} : smallest;
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

namespace {

/// How many wrong pixels of the sample a mesh has to do with.
struct Involved {
    std::uint64_t seen = 0;        ///< it is what is seen
    std::uint64_t falsely_lit = 0; ///< of these, lit in the picture alone
    std::uint64_t shadowed = 0; ///< lit in the picture alone, and this is in the way of the light
};

/// By mesh. Of several casters in the way of a pixel's light one counts: where each of them alone
/// would shadow the pixel, none of them mends it by throwing no shadow.
std::vector<Involved> involved_meshes(const Trial& trial) {
    const Scene& scene = trial.scene();
    std::vector<Involved> meshes(scene.meshes.size());
    std::vector<glm::dvec3> lines;
    for (const Patch& patch : trial.sample())
        for_each_pixel(patch, [&](int x, int y) {
            const std::uint32_t seen = trial.truth().triangle.at(x, y);
            if (!trial.is_wrong(x, y) || seen == no_triangle) return;
            Involved& mesh = meshes[mesh_of(scene, seen)];
            ++mesh.seen;
            if (trial.frame().claim.at(x, y) != Visibility::lit) return;
            ++mesh.falsely_lit;
            const std::uint32_t occluder =
                occluder_of(trial.traced().tracer(), line_of_sight(scene.camera, x + 0.5, y + 0.5));
            if (occluder != no_triangle) ++meshes[mesh_of(scene, occluder)].shadowed;
        });
    return meshes;
}

} // namespace

/// Those that have to do with enough of the wrong pixels to be considered at all, so that a scene
/// may have any number of meshes: twenty at most show enough false light, and as many shadow it.
void try_meshes(Trial& trial) {
    const Scene& scene = trial.scene();
    const GroundTruth& truth = trial.truth();
    const std::vector<Involved> involved = involved_meshes(trial);
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const Mesh& mesh = scene.meshes[m];
        const auto& [seen, falsely_lit, shadowed] = involved[m];
        const Parameters number{{"mesh", static_cast<double>(m)}};
        if (mesh.receives && trial.is_enough(falsely_lit))
            trial.consider(
                "receiver_missing", number, mesh.name + " shows no shadows",
                changed(trial.traced(), [&scene, &truth, m](std::size_t i, Visibility was) {
                    const bool own = mesh_of(scene, truth.triangle.pixels[i]) == m;
                    return own && in_cone(truth, i) ? Visibility::lit : was;
                }));
        if (scene.meshes.size() < 2) continue;
        const auto without_shadow = [&] {
            if (mesh.casts && trial.is_enough(shadowed))
                trial.consider("caster_missing", number, mesh.name + " casts no shadow",
                               truth_without(trial, [&scene, m] {
                                   Scene without = scene;
                                   without.meshes[m].casts = false;
                                   return without;
                               }));
        };
        // Where the picture shows nothing of it, a missing mesh looks like one without a shadow.
        // Of both, where they fit as well, the one comes first of which the picture shows more.
        const ShownMesh shown = shown_of(trial, m);
        const bool is_there = 2 * shown.right >= shown.pixels;
        if (is_there) without_shadow();
        if (trial.is_enough(shadowed + seen) && shown.pixels > 0)
            trial.consider("mesh_missing", number, mesh.name + " is not drawn",
                           with_mesh_missing(trial, m));
        if (!is_there) without_shadow();
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
    if (best.score <= 0) return;
    // Shadows that move within an edge's band are not wrong: many moves fit as well as the best.
    best = centred(trial, contracted(trial, axes, best, finest * glm::length(way)));
    const glm::dvec3& by = best.by;
    trial.consider("light_moved", {{"x", by.x}, {"y", by.y}, {"z", by.z}},
                   fmt::format("the light is moved by ({:.3g}, {:.3g}, {:.3g})", by.x, by.y, by.z),
                   with_light_moved(trial, by));
}

} // namespace shadowproof
