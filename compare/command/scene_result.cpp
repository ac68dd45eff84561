#include "compare/command/scene_result.h"

#include "compare/report/report.h"
#include "scenes/load/catalog.h"
#include "scenes/load/digest.h"
#include "scenes/plan/plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace shadowproof {

namespace {

std::vector<std::string> names_of(const std::vector<Cause>& causes) {
    std::vector<std::string> names;
    for (const Cause cause : causes) names.emplace_back(name_of(cause));
    return names;
}

std::string content_of(const std::string& digest, const std::vector<std::string>& provokes) {
    return fmt::format("{} {}", digest, fmt::join(provokes, " "));
}

} // namespace

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
    result.provokes = names_of(scene.provokes);
    result.notes = scene.notes;
}

std::optional<std::string> note_on_added_lights(const Scene& scene) {
    if (added_lights(scene) < 2) return std::nullopt;
    constexpr std::size_t most = 3;
    const std::size_t before = added_lights(scene) - 1;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < std::min(before, most); ++i)
        names.push_back(scene.lights[i].choice);
    const std::string more = before > most ? fmt::format(" and {} more", before - most) : "";
    return fmt::format("colours add the light of {}{} to that of {}", fmt::join(names, ", "), more,
                       chosen_light(scene).choice);
}

std::string content_of(const Scene& scene) {
    return content_of(digest_of(scene), names_of(scene.provokes));
}

std::string content_of(const SceneResult& result) {
    return content_of(result.digest, result.provokes);
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
