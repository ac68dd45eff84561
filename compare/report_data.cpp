#include "compare/report_data.h"

#include "compare/blocks.h"
#include "compare/color_picture.h"
#include "compare/light_json.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

namespace shadowproof {

namespace {

using Json = nlohmann::ordered_json;

Json vector_json(const glm::dvec3& v) {
    return Json::array({v.x, v.y, v.z});
}

using Blocks = std::vector<std::pair<std::string_view, std::string>>;

/// A line of script that hands the viewer an object by its name: what `header` says, and blocks.
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

/// Three bytes a pixel: those of the .png, whose pixels a page opened from disk may not read.
std::string picture_block(const Image<Rgb>& picture) {
    return block("u8", 3 * picture.pixels.size(), std::as_bytes(std::span(picture.pixels)));
}

/// In bytes where a counter fits into one.
std::string counter_block(const Image<std::uint32_t>& counter, const Counting& counting) {
    if (counting.bits > 8) return block(counter.pixels);
    return block(converted<std::uint8_t>(counter, [](std::uint32_t count) {
                     return static_cast<std::uint8_t>(count);
                 }).pixels);
}

std::string_view name_of(DepthModel::Projection projection) {
    switch (projection) {
    case DepthModel::Projection::finite:
        return "finite";
    case DepthModel::Projection::finite_reversed:
        return "finite_reversed";
    case DepthModel::Projection::infinite:
        return "infinite";
    case DepthModel::Projection::infinite_reversed:
        break;
    }
    return "infinite_reversed";
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
    const Counting& counting = cell.frame.counting;
    const DepthModel& depth = cell.frame.depth_model;
    const bool finite = std::isfinite(depth.far);
    Json header{{"counting",
                 {{"test", name_of(counting.test)},
                  {"operation", name_of(counting.operation)},
                  {"start", name_of(counting.start)},
                  {"depth_clamp", counting.depth_clamp},
                  {"light_cap", counting.light_cap},
                  {"dark_cap", counting.dark_cap},
                  {"bits", counting.bits}}},
                {"depth",
                 {{"projection", name_of(depth.projection)},
                  {"floating", depth.floating},
                  {"near", depth.near},
                  {"far", finite ? Json(depth.far) : Json(nullptr)}}}};
    if (!counting.casters.empty()) {
        Json& tests = header["counting"]["tests"] = Json::array(); // one a mesh
        for (const Mesh& mesh : scene.meshes)
            tests.push_back(name_of(counting.caster(mesh.first_triangle).test));
    }
    const LedgerTable& ledgers = cell.ledgers;
    Blocks blocks{{"claim", picture_block(cell.frame.claim)},
                  {"predicted", counter_block(cell.comparison.predicted, counting)},
                  {"read_back", counter_block(cell.frame.counter, counting)},
                  {"faces", block(cell.frame.volumes.pixels)},
                  {"seen", block(ledgers.seen)},
                  {"shown", block(ledgers.shown)},
                  {"exactness", block(ledgers.exactness)},
                  {"ledger", block(ledgers.ledger)},
                  {"ledger_start", block(ledgers.start)},
                  {"ledger_counts", block(ledgers.counts)},
                  {"ledger_exact", block(ledgers.adds_up)},
                  {"ledger_predicted", block(ledgers.predicted)},
                  {"crossing_face", block(ledgers.crossing_face)},
                  {"crossing_change", block(ledgers.crossing_change)},
                  {"crossing_status", block(ledgers.crossing_tally)},
                  {"face", block(ledgers.face)},
                  {"triangle", block(ledgers.triangle)},
                  {"vertex", block(ledgers.vertex)}};
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
