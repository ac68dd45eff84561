#include "compare/command/scene_result.h"

#include "compare/report/report.h"
#include "scenes/load/catalog.h"
#include "scenes/load/digest.h"
#include "scenes/plan/plan.h"

#include <fmt/format.h>

#include <algorithm>

namespace shadowproof {

void describe(SceneResult& result, const Scene& scene) {
    result.light = chosen_light(scene);
    // A bundled scene is the same wherever it is installed, and so is its report.
    result.file = (is_bundled(result.argument) ? scene.file.filename() : scene.file).string();
    result.width = scene.camera.width;
    result.height = scene.camera.height;
    result.triangles = scene.triangles.size();
    result.digest = digest_of(scene);
    result.camera = scene.camera;
    result.far = finite_far(scene);
    result.meshes = scene.meshes;
    for (const Cause cause : scene.provokes) result.provokes.emplace_back(name_of(cause));
    result.notes = scene.notes;
}

std::string unique_name(std::span<const SceneResult> before, const std::string& wanted) {
    SceneResult named;
    named.name = wanted;
    const auto is_taken = [&](const SceneResult& other) {
        return folder_of(other) == folder_of(named);
    };
    for (int number = 2; std::ranges::any_of(before, is_taken); ++number)
        named.name = fmt::format("{}-{}", wanted, number);
    return named.name;
}

} // namespace shadowproof
