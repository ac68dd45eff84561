#include "compare/json/json_file.h"
#include "compare/report/report.h"

namespace shadowproof {

namespace {

using Json = ResultsJson;

Json causes_of(const Comparison& comparison) {
    Json causes = Json::object();
    for (const CauseWords& words : all_causes) {
        const std::uint64_t pixels = comparison.causes[static_cast<std::size_t>(words.cause)];
        if (pixels > 0) causes[std::string(words.name)] = pixels;
    }
    return causes;
}

Json cause_of(const std::optional<Cause>& cause) {
    return cause ? Json(name_of(*cause)) : Json(nullptr);
}

Json since_of(const Since& since) {
    Json json{{"new", since.appeared}, {"gone", since.gone}, {"changed", since.changed}};
    if (const std::optional<PixelChange> first = first_of(since))
        json["first"] = {{"x", first->x},
                         {"y", first->y},
                         {"cause", cause_of(first->cause)},
                         {"was", cause_of(first->was)}};
    return json;
}

Json bins_of(const std::vector<ErrorBin>& bins) {
    Json json = Json::array();
    for (const ErrorBin& bin : bins)
        json.push_back(
            {{"from", bin.from}, {"to", bin.to}, {"pixels", bin.pixels}, {"rmse", bin.rmse}});
    return json;
}

Json means_of(const MeanCheck& means) {
    return {{"most_rays", means.most_rays},
            {"noise", means.noise},
            {"rmse", means.rmse},
            {"alike", means.alike},
            {"alike_rmse", means.alike_rmse},
            {"by_texels", bins_of(means.by_texels)},
            {"by_angle", bins_of(means.by_angle)}};
}

Json color_of(const ColorCheck& colors) {
    Json json{{"judged", colors.judged},
              {"largest", colors.largest},
              {"rmse", colors.rmse},
              {"picture_rmse", colors.picture_rmse},
              {"p999", colors.percentile999},
              {"beyond", colors.beyond},
              {"unpredicted", colors.unpredicted},
              {"moved", colors.moved},
              {"interpolated", colors.interpolated},
              {"bound_width",
               {{"median", colors.bound_width.median},
                {"p999", colors.bound_width.percentile999},
                {"widest", colors.bound_width.widest}}},
              {"normalise", name_of(colors.model.normalisation)},
              {"bumps", name_of(colors.model.bump_form)},
              {"vectors", name_of(colors.model.vectors)},
              {"tangents", name_of(colors.model.tangents)}};
    if (colors.model.normalisation == Normalisation::cube_map)
        json["cube_size"] = colors.model.cube_size;
    if (colors.model.normalisation == Normalisation::newton_raphson)
        json["newton_steps"] = colors.model.newton_steps;
    if (filters(colors.model)) {
        json["filter"] = name_of(colors.model.filter);
        json["anisotropy"] = colors.model.anisotropy;
    }
    if (colors.means) json["pixel_means"] = means_of(*colors.means);
    for (const ColorTerm term : all_color_terms)
        if (const std::uint64_t pixels = colors.beyond_by[static_cast<std::size_t>(term)])
            json["beyond_by"][std::string(name_of(term))] = pixels;
    if (colors.judged > 0) json["largest_at"] = {{"x", colors.largest_x}, {"y", colors.largest_y}};
    for (const LightAdded& light : colors.lights_before)
        json["lights_before"].push_back({{"name", light.name}, {"differing", light.differing}});
    if (colors.unpredicted > 0)
        json["first_unpredicted"] = {{"x", colors.first_unpredicted_x},
                                     {"y", colors.first_unpredicted_y}};
    return json;
}

Json cell_of(const Report& report, const SceneResult& scene, const Cell& cell) {
    Json json{{"name", cell.technique},
              {"summary", cell.summary},
              {"command", reproducing_command(report, scene, cell)},
              {"fails", fails(cell, report.gate)}};
    if (!cell.error.empty()) {
        json["error"] = cell.error;
        if (!could_not_run(cell)) json["verdict"] = name_of(cell.verdict);
        return json;
    }
    const Comparison& comparison = cell.comparison;
    json["family"] = cell.family;
    json["ms"] = cell.milliseconds;
    if (cell.spent_milliseconds > 0) json["spent_ms"] = cell.spent_milliseconds;
    if (!cell.left_out.empty()) json["left_out"] = cell.left_out;
    json["verdict"] = name_of(cell.verdict);
    json["pixels"] =
        static_cast<std::uint64_t>(scene.width) * static_cast<std::uint64_t>(scene.height);
    json["differing"] = comparison.differing;
    json["causes"] = causes_of(comparison);
    if (comparison.several > 0) json["several"] = comparison.several;
    if (comparison.too_near > 0) json["too_near"] = comparison.too_near;
    if (comparison.shares) {
        json["partly_lit"] = comparison.shares->partly_lit;
        json["wrongness"] = comparison.shares->wrongness;
    }
    if (comparison.first)
        json["first"] = {{"x", comparison.first->x},
                         {"y", comparison.first->y},
                         {"cause", name_of(comparison.first->cause)}};
    const EvidenceSummary& evidence = comparison.summary;
    if (!evidence.results.empty()) json.update(Json::parse(evidence.results));
    for (const char* const kind : picture_kinds)
        json["images"][kind] = picture_path(scene, cell, kind);
    if (comparison.colors) json["color"] = color_of(*comparison.colors);
    json["cause_map"] = cell.cause_map;
    if (cell.since) json["since"] = since_of(*cell.since);
    for (const Acceptance& one : cell.accepted)
        json["accepted"].push_back({{"cause", name_of(one.cause)}, {"reason", one.reason}});
    return json;
}

Json scene_of(const Report& report, const SceneResult& scene) {
    Json json{{"name", scene.name},
              {"file", scene.file},
              {"width", scene.width},
              {"height", scene.height}};
    if (!scene.error.empty()) {
        json["error"] = scene.error;
        return json;
    }
    const TraceStatistics& traced = scene.truth.statistics;
    json["folder"] = folder_of(scene);
    json["digest"] = scene.digest;
    json["triangles"] = scene.triangles;
    json["light"] = scene.light.name;
    json["light_kind"] = name_of(scene.light.kind);
    json["provokes"] = scene.provokes;
    json["no_longer_provoked"] = scene.no_longer_provoked;
    json["left_out"] = scene.left_out;
    json["notes"] = scene.notes;
    json["reference"] = {{"ms", traced.milliseconds},
                         {"build_ms", traced.build_milliseconds},
                         {"rays", traced.rays},
                         {"exact_decisions", traced.exact_decisions},
                         {"lit", traced.lit},
                         {"shadowed", traced.shadowed},
                         {"background", traced.background},
                         {"degenerate", traced.degenerate}};
    if (scene.spent_milliseconds > 0) json["spent_ms"] = scene.spent_milliseconds;
    json["images"] = {{"truth", truth_path(scene)}};
    json["techniques"] = Json::array();
    for (const Cell& cell : scene.cells) json["techniques"].push_back(cell_of(report, scene, cell));
    return json;
}

} // namespace

std::string to_json(const Report& report) {
    Json json{{"schema", results_schema},
              {"format", results_format},
              {"version", report.version},
              {"gl",
               {{"version", report.gl.version},
                {"renderer", report.gl.renderer},
                {"subpixel_bits", report.gl.subpixel_bits},
                {"depth_bits", report.gl.depth_bits},
                {"stencil_bits", report.gl.stencil_bits}}},
              {"embree", report.embree},
              {"arguments", report.arguments},
              {"gate", name_of(report.gate.on)},
              {"allow", Json::array()},
              {"passed", report.passed},
              {"ms", report.milliseconds},
              {"report_ms", report.report_milliseconds},
              {"scenes", Json::array()}};
    for (const Allowance& allowance : report.gate.allow)
        json["allow"].push_back(words_of(allowance));
    if (report.baseline)
        json["baseline"] = {{"file", report.baseline->file},
                            {"passed", report.baseline->passed},
                            {"notes", report.baseline->notes}};
    if (report.shard) {
        json["shard"] = {
            {"number", report.shard->number}, {"of", report.shard->of}, {"run", report.shard->run}};
        if (!report.shard->baseline.empty())
            json["shard"]["baseline"] = Json::parse(report.shard->baseline);
    }
    for (const SceneResult& scene : report.scenes)
        json["scenes"].push_back(scene_of(report, scene));
    // A file name need not be UTF-8; what is not is shown as U+FFFD.
    return results_text(json);
}

} // namespace shadowproof
