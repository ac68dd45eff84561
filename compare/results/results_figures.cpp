#include "compare/results/results_figures.h"

#include "compare/json/blocks.h"
#include "compare/json/json_rules.h"
#include "compare/results/results_check.h"
#include "scenes/cause.h"

#include <array>
#include <numeric>
#include <optional>

namespace shadowproof {

using namespace json_rules;

namespace {

using Json = ResultsJson;

/// What a picture's path must begin with; the rest is "NAME.png", or where it may be another cell's
/// "TECHNIQUE.NAME.png".
void pictures_in(const JsonPlace& images, const std::string& folder, bool of_cells) {
    for (const auto& [name, path] : images.value.items()) {
        const JsonPlace place = images.at(name);
        require(path.is_string(), place, "a string");
        const auto& whole = path.get_ref<const std::string&>();
        const bool begins = whole.starts_with(folder + "/") && whole.ends_with(".png") &&
                            whole.size() > folder.size() + 5;
        std::string_view rest =
            begins ? std::string_view(whole).substr(folder.size() + 1) : std::string_view();
        rest = rest.substr(0, rest.size() - std::min<std::size_t>(rest.size(), 4));
        const std::size_t dot = rest.find('.');
        const bool beneath = dot == std::string_view::npos
                                 ? is_plain_name(rest)
                                 : of_cells && is_technique_name(rest.substr(0, dot)) &&
                                       is_plain_name(rest.substr(dot + 1));
        require(beneath, place,
                fmt::format("the path of a picture, \"{}/{}NAME.png\"", folder,
                            of_cells ? "TECHNIQUE." : ""));
    }
}

using CausePixels = std::array<std::uint64_t, all_causes.size()>;

CausePixels pixels_by_cause(const Json& causes) {
    CausePixels pixels{};
    for (const auto& [name, count] : causes.items())
        pixels[static_cast<std::size_t>(*cause_named(name))] = count.get<std::uint64_t>();
    return pixels;
}

/// Checks that the counts are those of the map.
void check_cause_map(const JsonPlace& map, const CausePixels& counts, std::uint64_t pixels) {
    const auto& packed_map = map.value.get_ref<const std::string&>();
    // No zlib stream grows more than 1032-fold (zlib technical details): a small text that claims
    // a huge picture takes no memory. Base64 is longer than its bytes, and 16 covers the rest.
    const bool possible = pixels / 1032 <= packed_map.size() + 16;
    const auto bytes = possible ? unpacked(packed_map, pixels) : std::nullopt;
    if (!bytes) refuse(map, "is damaged: it is not base64 of a zlib stream of a byte a pixel");
    CausePixels found{};
    for (const std::uint8_t byte : *bytes) {
        if (byte == no_difference) continue;
        if (byte >= found.size()) refuse(map, fmt::format("holds {}, which is no cause", byte));
        ++found[byte];
    }
    for (std::size_t i = 0; i < found.size(); ++i)
        if (found[i] != counts[i])
            refuse(map, fmt::format("shows {} pixels of {}, but the cell counts {}", found[i],
                                    all_causes[i].name, counts[i]));
}

/// An eye ray for each pixel, and at most one to the light for what it sees.
void check_rays(const JsonPlace& reference, std::uint64_t pixels) {
    const auto rays = reference.value.at("rays").get<std::uint64_t>();
    const std::uint64_t seen = sum(reference.value, {"lit", "shadowed"});
    require(
        rays >= pixels && rays <= pixels + seen, reference.at("rays"),
        fmt::format("from {} to {}, as many as that many pixels ask for", pixels, pixels + seen));
    require(reference.value.at("degenerate").get<std::uint64_t>() <= pixels,
            reference.at("degenerate"), "no more than all pixels");
}

} // namespace

void check_cell_figures(const JsonPlace& cell, const Json& scene) {
    if (could_not_run(cell.value)) return;
    const std::string folder = scene.at("folder").get<std::string>();
    pictures_in(cell.at("images"), folder, true);
    const auto width = scene.at("width").get<std::uint64_t>();
    const auto height = scene.at("height").get<std::uint64_t>();
    const auto pixels = cell.value.at("pixels").get<std::uint64_t>();
    const auto differing = cell.value.at("differing").get<std::uint64_t>();
    require(pixels == width * height, cell.at("pixels"),
            fmt::format("{}, the size of its scene", width * height));
    const CausePixels counts = pixels_by_cause(cell.value.at("causes"));
    require_sum(cell.at("causes"), std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}),
                differing, "\"differing\"");
    check_cause_map(cell.at("cause_map"), counts, pixels);
    if (cell.value.contains("several"))
        require(cell.value.at("several").get<std::uint64_t>() <= differing, cell.at("several"),
                "no more than \"differing\"");
    if (cell.value.contains("too_near"))
        require(cell.value.at("too_near").get<std::uint64_t>() <=
                    counts[static_cast<std::size_t>(Cause::precision)],
                cell.at("too_near"), "no more than the pixels of \"precision\"");
    if (cell.value.contains("first") != (differing > 0))
        refuse(cell, differing > 0 ? "lacks \"first\", though pixels differ"
                                   : "has \"first\", though no pixel differs");
    if (differing == 0) return;
    const Json& at = cell.value.at("first");
    require(at.at("x").get<std::uint64_t>() < width && at.at("y").get<std::uint64_t>() < height,
            cell.at("first"), "a pixel of the picture");
}

void check_scene_figures(const JsonPlace& scene) {
    pictures_in(scene.at("images"), scene.value.at("folder").get<std::string>(), false);
    const auto pixels = scene.value.at("width").get<std::uint64_t>() *
                        scene.value.at("height").get<std::uint64_t>();
    check_rays(scene.at("reference"), pixels);
    require_sum(scene.at("reference"),
                sum(scene.value.at("reference"), {"lit", "shadowed", "background"}), pixels,
                "the scene's size");
}

} // namespace shadowproof
