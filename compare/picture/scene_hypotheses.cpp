#include "compare/picture/hypotheses.h"
#include "reference/predict/whole_casters.h"
#include "scenes/camera.h"
#include "scenes/surface/alpha_mask.h"

#include <fmt/format.h>

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

/// The truth without the mesh. In its place shows what is behind it, or a background, which may be
/// as dark as shadow: it is not read as it is, by the mesh's colours or by what light adds to the
/// mesh. So any pixel there may be wrong, and is explained; right are those alone that what is
/// behind would be, too.
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
    std::uint64_t seen = 0;        ///< that see it
    std::uint64_t falsely_lit = 0; ///< of these, lit in the picture alone
    std::uint64_t shadowed = 0; ///< lit in the picture alone, and this is in the way of the light
};

/// By mesh. Of several casters in the way of a pixel's light one counts: where each of them alone
/// would shadow the pixel, none of them mends it by throwing no shadow. A receiver without shadows
/// mends false light on itself alone, and a mesh that is gone what it shadows or hides.
std::vector<Involved> involved_meshes(const Trial& trial) {
    const Scene& scene = trial.scene();
    std::vector<Involved> meshes(scene.meshes.size());
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
/// may have any number of meshes: twenty at most show enough false light, twenty shadow it, and
/// forty do one or the other.
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
        if (scene.meshes.size() < 2 || !trial.is_enough(shadowed + seen)) continue;
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
        // Where both fit equally well, the first wins: without a shadow if most of it looks right.
        const ShownMesh shown = shown_of(trial, m);
        const bool is_there = 2 * shown.right >= shown.pixels;
        if (is_there) without_shadow();
        if (shown.pixels > 0)
            trial.consider("mesh_missing", number, mesh.name + " is not drawn",
                           with_mesh_missing(trial, m),
                           is_there ? Settles::never : Settles::perhaps);
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

} // namespace shadowproof
