#include "compare/report/report_pictures.h"

#include "compare/report/report_data.h"
#include "reference/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <optional>
#include <utility>

namespace shadowproof {

namespace {

/// The dimmed claim, and where mark(i) is a number that colour of `marks`.
template <class Colors, class ColorOf, class Mark>
PalettePicture marked(const Cell& cell, const Colors& marks, ColorOf color_of, Mark mark) {
    const Image<Visibility>& claim = cell.frame.claim;
    PalettePicture picture{
        Image<std::uint8_t>(claim.width, claim.height),
        {dimmed(Visibility::lit), dimmed(Visibility::shadowed), dimmed(Visibility::background)}};
    for (const auto& each : marks) picture.palette.push_back(color_of(each));
    for (std::size_t i = 0; i < picture.indices.pixels.size(); ++i) {
        const std::optional<int> number = mark(i);
        picture.indices.pixels[i] = number ? static_cast<std::uint8_t>(dimmed_count + *number)
                                           : dimmed_index(claim.pixels[i]);
    }
    return picture;
}

} // namespace

std::string folder_of(const SceneResult& scene) {
    std::string folder = scene.name;
    for (char& c : folder) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                           (c >= '0' && c <= '9') || c == '-' || c == '_';
        if (!plain) c = '_';
    }
    // File systems take 255 bytes. The end tells one light's from another's.
    constexpr std::size_t longest = 200;
    constexpr std::size_t end = 60;
    if (folder.size() > longest)
        folder = folder.substr(0, longest - end - 1) + "_" + folder.substr(folder.size() - end);
    return folder.empty() ? "scene" : folder;
}

std::string own_path(const SceneResult& scene, const Cell& cell, const std::string& kind) {
    return fmt::format("{}/{}.{}.png", folder_of(scene), cell.technique, kind);
}

std::string picture_path(const SceneResult& scene, const Cell& cell, const std::string& kind) {
    const auto same = cell.same_pictures.find(kind);
    return same != cell.same_pictures.end() ? same->second : own_path(scene, cell, kind);
}

std::string script_path(const SceneResult& scene, const Cell& cell) {
    return fmt::format("{}/{}.cell.js", folder_of(scene), cell.technique);
}

std::string truth_path(const SceneResult& scene) {
    return folder_of(scene) + "/truth.png";
}

PalettePicture difference_picture(const GroundTruth& truth, const Cell& cell) {
    return marked(
        cell, all_contradictions, [](const ContradictionWords& words) { return words.color; },
        [&](std::size_t i) -> std::optional<int> {
            const Visibility right = truth.visibility.pixels[i];
            const Visibility claim = cell.frame.claim.pixels[i];
            if (right == claim) return std::nullopt; // though colours may differ
            return static_cast<int>(contradiction(right, claim));
        });
}

PalettePicture cause_picture(const Cell& cell) {
    return marked(
        cell, cause_colors, [](const Rgb& color) { return color; },
        [&](std::size_t i) -> std::optional<int> {
            const std::uint8_t cause = cell.comparison.cause.pixels[i];
            return cause == no_difference ? std::nullopt : std::optional<int>(cause);
        });
}

void write_scene(const SceneResult& scene, const FolderPart& report) {
    report.add(truth_path(scene), to_png(scene.truth.visibility));
    report.add(folder_of(scene) + "/scene.js", scene_script(scene));
}

void write_cell(const SceneResult& scene, Cell& cell, const FolderPart& report, Memo& memo,
                SharedFiles* shared, int threads) {
    if (!cell.error.empty()) return;
    std::string script;
    std::deque<std::pair<std::string, std::string>> pictures; // kinds and bytes; they stay in place
    std::vector<std::function<void()>> jobs{
        [&] { script = cell_script(scene, cell, memo); },
        [&] { cell.cause_map = packed_cause_map(cell.comparison, &memo); }};
    const auto add = [&](const std::string& kind, const std::function<std::string()>& png) {
        std::string& bytes = pictures.emplace_back(kind, std::string()).second;
        jobs.emplace_back([&bytes, png] { bytes = png(); });
    };
    add("claim", [&] { return to_png(cell.frame.claim, &memo); });
    add("difference", [&] { return to_png(difference_picture(scene.truth, cell), &memo); });
    add("cause", [&] { return to_png(cause_picture(cell), &memo); });
    parallel_for(static_cast<int>(jobs.size()), thread_count(threads),
                 [&](int job, int) { jobs[static_cast<std::size_t>(job)](); });
    for (const auto& [kind, bytes] : pictures) {
        const std::string path = own_path(scene, cell, kind);
        const std::string place = shared != nullptr ? shared->place_of(path, bytes) : path;
        if (place == path)
            report.add(path, bytes);
        else
            cell.same_pictures[kind] = place;
    }
    const std::string path = script_path(scene, cell);
    report.add(path, shared != nullptr ? shared->shared(path, script) : script);
}

} // namespace shadowproof
