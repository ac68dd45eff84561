#include "compare/command/bench/measured_scene.h"

#include "compare/bench/kept.h"
#include "scenes/load/catalog.h"
#include "scenes/load/digest.h"

#include <fmt/format.h>

#include <algorithm>

namespace shadowproof {

namespace {

/// Two files may have one stem: the second is "stem-2".
std::string unique_name(const BenchRun& run, const std::string& wanted) {
    std::string name = wanted;
    const auto is_taken = [&](const BenchScene& scene) { return scene.name == name; };
    for (int number = 2; std::any_of(run.scenes.begin(), run.scenes.end(), is_taken); ++number)
        name = fmt::format("{}-{}", wanted, number);
    return name;
}

/// Whether an earlier run has each technique that is asked for now, or says why not.
bool has_all(const BenchRun& kept, const BenchScene& scene, const BenchWork& work,
             const Scene& read) {
    const TechniqueOptions& options = work.options.technique;
    return std::ranges::all_of(options.chosen(), [&](const Technique* technique) {
        const auto is_its = [&](const auto& each) {
            return each.scene == scene.name && each.technique == technique->name;
        };
        return (options.techniques.empty() && !suits(*technique, read)) ||
               std::ranges::any_of(kept.points, is_its) ||
               std::ranges::any_of(kept.left_out, is_its);
    });
}

} // namespace

BenchScene measured_scene(const BenchRun& run, const BenchRun* kept, const Scene& scene,
                          const std::string& argument) {
    BenchScene described{.name = unique_name(run, scene.name),
                         .file =
                             (is_bundled(argument) ? scene.file.filename() : scene.file).string(),
                         .digest = digest_of(scene),
                         .light = chosen_light(scene).name,
                         .width = static_cast<std::uint64_t>(scene.camera.width),
                         .height = static_cast<std::uint64_t>(scene.camera.height),
                         .triangles = scene.triangles.size(),
                         .finished = false};
    if (kept == nullptr) return described;
    for (const BenchScene& known : kept->scenes)
        if (are_one_picture(known, described) && known.file == described.file &&
            unique_name(run, known.name) == known.name) {
            described.name = known.name;
            break;
        }
    return described;
}

bool take_over(const BenchWork& work, BenchScene& scene, const Scene& read) {
    if (work.kept == nullptr) return false;
    const BenchScene* const kept = kept_scene(work.options.json, *work.kept, scene);
    if (work.pictures != nullptr || kept == nullptr || !kept->finished ||
        !has_all(*work.kept, scene, work, read))
        return false;
    scene.finished = true;
    for (const BenchPoint& point : work.kept->points)
        if (point.scene == scene.name) work.run.points.push_back(point);
    for (const BenchLeftOut& out : work.kept->left_out)
        if (out.scene == scene.name) work.run.left_out.push_back(out);
    return true;
}

} // namespace shadowproof
