#include "compare/report/report_data.h"

#include "compare/json/blocks.h"
#include "compare/judge/crossing_json.h"
#include "compare/report/color_picture.h"
#include "compare/report/light_json.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

namespace shadowproof {

namespace {

using Json = nlohmann::ordered_json;

/// A line of script that hands the viewer an object by its name: the members of `header`, and
/// blocks.
std::string script(std::string_view function, const std::string& name, const Json& header,
                   const Blocks& blocks) {
    std::string text = fmt::format("shadowproof.{}(\"{}\", ", function, name);
    text += header.dump(-1, ' ', true, Json::error_handler_t::replace); // ASCII alone
    text.back() = ',';
    text += "\n\"blocks\":{";
    for (const auto& [block_name, values] : blocks)
        text += fmt::format("{}\n\"{}\":{}", &block_name == &blocks.front().first ? "" : ",",
                            block_name, values);
    return text + "}});\n";
}

/// Three bytes for each pixel: those of the .png, whose pixels a page opened from disk may not
/// read.
NumberList color_list(const Image<Rgb>& picture) {
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(picture.pixels.data());
    return NumberList(std::span(bytes, 3 * picture.pixels.size()));
}

/// no_difference where the claim has the truth's visibility, else 0.
NumberList difference_list(const SceneResult& scene, const Cell& cell) {
    std::vector<std::uint8_t> list;
    list.reserve(cell.frame.claim.pixels.size());
    for (std::size_t i = 0; i < cell.frame.claim.pixels.size(); ++i)
        list.push_back(cell.frame.claim.pixels[i] == scene.truth.visibility.pixels[i]
                           ? no_difference
                           : std::uint8_t{0});
    return NumberList(list);
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
                  {"orthographic", camera.is_orthographic()},
                  {"half_height", camera.half_height},
                  {"near", camera.near}}},
                {"far", scene.far},
                {"light", light_json(scene.light)},
                {"meshes", Json::array()}};
    for (const Mesh& mesh : scene.meshes)
        header["meshes"].push_back(
            {{"name", mesh.name}, {"first", mesh.first_triangle}, {"count", mesh.triangle_count}});
    const NumberList visibility(scene.truth.visibility.pixels);
    const Guide by_visibility{"visibility", &visibility};
    Blocks blocks{
        {"visibility", areas_block(visibility, scene.width)},
        {"seen", areas_block(NumberList(scene.truth.triangle.pixels), scene.width, by_visibility)},
        {"exactness",
         areas_block(NumberList(scene.truth.exactness.pixels), scene.width, by_visibility)}};
    if (!scene.color.pixels.empty()) {
        const NumberList color = color_list(color_picture(scene.color));
        blocks.emplace_back("color", shades_block(color, scene.width, 3));
        if (!scene.mean_color.pixels.empty())
            blocks.emplace_back("mean_color",
                                shades_block(color_list(color_picture(scene.mean_color)),
                                             scene.width, 3, {"color", &color}));
    }
    return script("scene", folder_of(scene), header, blocks);
}

std::string cell_script(const SceneResult& scene, const Cell& cell, Memo& memo) {
    Json header = Json::object();
    const NumberList truth(scene.truth.visibility.pixels);
    const NumberList claim(cell.frame.claim.pixels);
    const NumberList causes(cell.comparison.cause.pixels);
    const auto guided = [&](const NumberList& list, std::string_view name, const NumberList& by) {
        return areas_block(list, scene.width, {name, &by}, &memo);
    };
    Blocks blocks{{"claim", guided(claim, "visibility", truth)},
                  {"cause", guided(causes, "difference", difference_list(scene, cell))}};
    if (!cell.frame.share.pixels.empty())
        blocks.emplace_back("share",
                            guided(NumberList(std::vector<float>(cell.frame.share.pixels.begin(),
                                                                 cell.frame.share.pixels.end())),
                                   "claim", claim));
    if (cell.evidence) {
        header = Json::parse(cell.evidence->header());
        for (auto& named : cell.evidence->blocks(cell.frame, scene.truth, memo))
            blocks.push_back(std::move(named));
    }
    header["family"] = cell.family;
    if (cell.comparison.colors) {
        const Image<ColorVerdict>& verdicts = cell.comparison.colors->verdict;
        const bool of_pixels = filters(cell.comparison.colors->model);
        const NumberList right =
            color_list(color_picture(of_pixels ? scene.mean_color : scene.color));
        blocks.emplace_back("color", shades_block(color_list(color_picture(cell.frame.color)),
                                                  scene.width, 3, {"true_color", &right}, &memo));
        blocks.emplace_back("color_verdict", guided(NumberList(verdicts.pixels), "claim", claim));
    }
    return script("cell", folder_of(scene) + "/" + cell.technique, header, blocks);
}

std::string results_script(const std::string& results_json) {
    Json results = Json::parse(results_json);
    for (Json& scene : results["scenes"]) scene = packed_scene(std::move(scene));
    return "shadowproof.results(" + results.dump() + ");\n";
}

std::string packed_scene(Json scene) {
    if (scene.contains("techniques"))
        for (Json& cell : scene["techniques"]) cell.erase("cause_map");
    const std::string text = scene.dump();
    return packed(std::as_bytes(std::span(text)));
}

std::string packed_cause_map(const Comparison& comparison, Memo* memo) {
    const Memo::Bytes causes = bytes_for_memo(comparison.cause.pixels);
    return remembered(memo, {bytes_for_memo(std::string_view("cause_map")), causes},
                      [&] { return packed(causes); });
}

} // namespace shadowproof
