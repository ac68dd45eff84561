#include "compare/report/report_data.h"

#include "compare/json/blocks.h"
#include "compare/judge/crossing_json.h"
#include "compare/report/color_picture.h"
#include "compare/report/light_json.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

namespace shadowproof {

namespace {

using Json = nlohmann::ordered_json;

/// A line of script that hands the viewer an object by its name: the members of `header`, and
/// blocks.
std::string script(std::string_view function, const std::string& name, const Json& header,
                   const Blocks& blocks) {
    std::string text = fmt::format("shadowproof.{}(\"{}\", ", function, name);
    text += header.dump(-1, ' ', false, Json::error_handler_t::replace);
    text.back() = ',';
    text += "\n\"blocks\":{";
    for (const auto& [block_name, values] : blocks)
        text += fmt::format("{}\n\"{}\":{}", &block_name == &blocks.front().first ? "" : ",",
                            block_name, values);
    return text + "}});\n";
}

/// Visibility's values are bytes already.
std::string picture_block(const Image<Visibility>& picture) {
    return block("u8", picture.pixels.size(), std::as_bytes(std::span(picture.pixels)));
}

/// Shares of light: a float each.
std::string picture_block(const Image<double>& shares) {
    return block(std::vector<float>(shares.pixels.begin(), shares.pixels.end()));
}

/// Three bytes per pixel: those of the .png, whose pixels a page opened from disk may not read.
std::string picture_block(const Image<Rgb>& picture) {
    return block("u8", 3 * picture.pixels.size(), std::as_bytes(std::span(picture.pixels)));
}

} // namespace

std::string scene_script(const SceneResult& scene) {
    const Camera& camera = scene.camera;
    Json header{{"width", scene.width},
                {"height", scene.height},
                {"camera",
                 {{"eye", vector_json(camera.eye)},
                  {"right", vector_json(camera.right)},
                  {"up", vector_json(camera.up)},
                  {"forward", vector_json(camera.forward)},
                  {"tan_half_height", camera.tan_half_height},
                  {"near", camera.near}}},
                {"far", scene.far},
                {"light", light_json(scene.light)},
                {"meshes", Json::array()}};
    for (const Mesh& mesh : scene.meshes)
        header["meshes"].push_back(
            {{"name", mesh.name}, {"first", mesh.first_triangle}, {"count", mesh.triangle_count}});
    Blocks blocks{{"visibility", picture_block(scene.truth.visibility)}};
    if (!scene.color.pixels.empty())
        blocks.emplace_back("color", picture_block(color_picture(scene.color)));
    return script("scene", folder_of(scene), header, blocks);
}

std::string cell_script(const SceneResult& scene, const Cell& cell) {
    Json header = Json::object();
    Blocks blocks{{"claim", picture_block(cell.frame.claim)}};
    if (!cell.frame.share.pixels.empty())
        blocks.emplace_back("share", picture_block(cell.frame.share));
    if (cell.evidence) {
        header = Json::parse(cell.evidence->header());
        for (auto& named : cell.evidence->blocks(cell.frame)) blocks.push_back(std::move(named));
    }
    header["family"] = cell.family;
    if (cell.comparison.colors) {
        const Image<ColorVerdict>& verdicts = cell.comparison.colors->verdict;
        blocks.emplace_back("color", picture_block(color_picture(cell.frame.color)));
        blocks.emplace_back("color_verdict", block("u8", verdicts.pixels.size(),
                                                   std::as_bytes(std::span(verdicts.pixels))));
    }
    return script("cell", folder_of(scene) + "/" + cell.technique, header, blocks);
}

std::string results_script(const std::string& results_json) {
    return "shadowproof.results(" + results_json + ");\n";
}

std::string packed_cause_map(const Comparison& comparison) {
    return packed(std::as_bytes(std::span(comparison.cause.pixels)));
}

} // namespace shadowproof
