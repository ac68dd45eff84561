#include "compare/command/commands.h"
#include "compare/command/console.h"
#include "compare/command/stopwatch.h"
#include "compare/report_data.h"
#include "raster/render.h"
#include "scenes/catalog.h"
#include "scenes/digest.h"
#include "scenes/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace shadowproof {

namespace {

struct VerifyOptions {
    std::vector<std::string> scenes;
    SceneOptions scene;
    TechniqueOptions technique;
    std::string out = "report";
    std::string json;
    std::string junit;
    Gate gate = Gate::defects;
    bool quiet = false;
};

bool is_bundled(const std::string& name) {
    const auto& all = bundled_scenes();
    return std::any_of(all.begin(), all.end(),
                       [&](const BundledScene& scene) { return scene.name == name; });
}

std::vector<std::string> scenes_to_verify(const VerifyOptions& options) {
    if (!options.scenes.empty()) return options.scenes;
    std::vector<std::string> all;
    for (const BundledScene& scene : bundled_scenes()) all.emplace_back(scene.name);
    return all;
}

template <class Names>
std::vector<std::string> cause_names(const Names& causes) {
    std::vector<std::string> names;
    for (const Cause cause : causes) names.emplace_back(name_of(cause));
    return names;
}

/// A frame without a single surface, where the truth has some, proves nothing.
void refuse_blank(const Technique& technique, const GroundTruth& truth, const Frame& frame) {
    const bool has_surfaces = truth.statistics.lit + truth.statistics.shadowed > 0;
    const bool blank = std::all_of(frame.triangle.pixels.begin(), frame.triangle.pixels.end(),
                                   [](std::uint32_t id) { return id == no_triangle; });
    if (has_surfaces && blank)
        throw Error(std::string(technique.name), "blank render: no pixel shows a surface",
                    "see what the driver says, or try another with --gl");
}

/// One scene while its techniques are tried in turn.
struct Trial {
    const Scene& scene;
    const Plan& plan;
    const Tracer& tracer;
    const GroundTruth& truth;
    const ShadowDepths& depths;
    const Silhouette& silhouette;
    double& report_milliseconds; ///< grows by what the report takes
};

Cell try_technique(const Trial& trial, const Technique& technique, Gpu& gpu) {
    Cell cell;
    cell.technique = technique.name;
    cell.summary = technique.summary;
    try {
        cell.frame = render(technique, trial.scene, trial.plan, gpu);
        cell.milliseconds = cell.frame.milliseconds;
        refuse_blank(technique, trial.truth, cell.frame);
        cell.comparison = classify(trial.tracer, trial.truth, trial.depths, cell.frame);
        cell.verdict = judge(trial.scene, technique.fails_at, cell.comparison);
        const Stopwatch stopwatch;
        cell.ledgers = list_ledgers(trial.tracer, trial.silhouette, trial.truth, trial.depths,
                                    cell.frame, cell.comparison.cause);
        trial.report_milliseconds += stopwatch.milliseconds();
    } catch (const Error& error) {
        cell.error = error.what();
    }
    return cell;
}

/// What the scene declares and no technique shows any more. Only the default picture, and all
/// techniques, can tell.
std::vector<Cause> stopped_provoking(const VerifyOptions& options, const Scene& scene,
                                     const SceneResult& result) {
    const bool whole = options.technique.techniques.empty() && options.scene.is_default();
    if (!whole || !is_bundled(result.argument)) return {};
    std::vector<std::vector<Cause>> fails_at;
    std::vector<Comparison> comparisons;
    for (const Cell& cell : result.cells) {
        if (!cell.error.empty()) return {}; // who could not run may be the one that shows it
        fails_at.push_back(find_technique(cell.technique)->fails_at);
        comparisons.push_back(cell.comparison);
    }
    return no_longer_provoked(scene, fails_at, comparisons);
}

ColumnWidths widths_of(const VerifyOptions& options, const std::string& scene) {
    ColumnWidths widths{.technique = 0, .scene = static_cast<int>(scene.size()), .verdict = 0};
    for (const Technique* technique : options.technique.chosen())
        widths.technique = std::max(widths.technique, static_cast<int>(technique->name.size()));
    for (const Verdict verdict :
         {Verdict::agrees, Verdict::fails_as_predicted, Verdict::defect, Verdict::unexplained})
        widths.verdict = std::max(widths.verdict, static_cast<int>(name_of(verdict).size()));
    return widths;
}

void describe(Console& console, const SceneResult& result) {
    console.heading(result.name);
    console.line(fmt::format("  {} triangles, {}x{}, light {}", grouped(result.triangles),
                             result.width, result.height, result.light));
    for (const std::string& note : result.notes) console.line("  note: " + note);
    for (const std::string& clause : result.left_out) console.line("  left out: " + clause);
}

void verify_scene(const VerifyOptions& options, SceneResult& result, Gpu& gpu, Console& console,
                  double& report_milliseconds) {
    console.progress(fmt::format("{}: reading", result.name));
    const Scene scene = load_scene(result.argument, options.scene.request());
    result.name = scene.name;
    // A bundled scene is the same wherever it is installed, and so is its report.
    result.file = (is_bundled(result.argument) ? scene.file.filename() : scene.file).string();
    result.width = scene.camera.width;
    result.height = scene.camera.height;
    result.triangles = scene.triangles.size();
    result.digest = digest_of(scene);
    result.light = chosen_light(scene).name;
    result.light_position = chosen_light(scene).position;
    result.camera = scene.camera;
    result.far = finite_far(scene);
    result.meshes = scene.meshes;
    result.provokes = cause_names(scene.provokes);
    result.notes = scene.notes;
    const Plan plan = make_plan(scene);
    result.left_out = plan.left_out;
    describe(console, result);

    console.progress(fmt::format("{}: tracing", result.name));
    const Tracer tracer(scene, options.scene.threads);
    result.truth = trace(tracer);
    const ShadowDepths depths = count_shadow_depths(tracer, result.truth, result.far);
    const Stopwatch stopwatch;
    const Silhouette silhouette(tracer);
    report_milliseconds += stopwatch.milliseconds();
    const Trial trial{scene, plan, tracer, result.truth, depths, silhouette, report_milliseconds};
    const ColumnWidths widths = widths_of(options, result.name);
    for (const Technique* technique : options.technique.chosen()) {
        console.progress(fmt::format("{}: {}", result.name, technique->name));
        const Cell& cell = result.cells.emplace_back(try_technique(trial, *technique, gpu));
        console.cell(result, cell, widths, fails(cell, options.gate));
    }
    result.no_longer_provoked = cause_names(stopped_provoking(options, scene, result));
    for (const std::string& cause : result.no_longer_provoked)
        console.always(fmt::format("{}: no technique shows {} any more, which the scene declares",
                                   result.name, cause));
}

/// Pictures are on the disk by now; the figures stay.
void drop_pictures(SceneResult& scene) {
    const TraceStatistics statistics = scene.truth.statistics;
    scene.truth = {};
    scene.truth.statistics = statistics;
    for (Cell& cell : scene.cells) {
        cell.frame = {};
        cell.ledgers = {};
        cell.comparison.cause = {};
        cell.comparison.ledger_miss = {};
        cell.comparison.predicted = {};
    }
}

/// Two files may have one stem; their pictures need a folder each.
std::string unique_folder(const Report& report, const SceneResult& result) {
    const auto taken = [&](const std::string& folder) {
        SceneResult as_named;
        as_named.folder = folder;
        return std::any_of(
            report.scenes.begin(), report.scenes.end(), [&](const SceneResult& other) {
                return &other != &result && truth_path(other) == truth_path(as_named);
            });
    };
    std::string folder = result.name;
    for (int number = 2; taken(folder); ++number)
        folder = fmt::format("{}-{}", result.name, number);
    return folder;
}

int exit_code(const Report& report) {
    bool could_not = false;
    for (const SceneResult& scene : report.scenes) {
        could_not = could_not || !scene.error.empty();
        for (const Cell& cell : scene.cells) could_not = could_not || !cell.error.empty();
    }
    if (could_not) return exit_could_not;
    return report.passed ? exit_passed : exit_failed;
}

/// How to see again what failed, and where the report lies.
void conclude(Console& console, const Report& report, const VerifyOptions& options) {
    std::size_t cells = 0;
    std::size_t failing = 0;
    std::size_t unread = 0;
    std::size_t unprovoked = 0;
    for (const SceneResult& scene : report.scenes) {
        for (const Cell& cell : scene.cells) {
            ++cells;
            if (!fails(cell, report.gate)) continue;
            ++failing;
            console.always("reproduce: " + reproducing_command(report, scene, cell));
        }
        if (!scene.error.empty()) ++unread;
        if (scene.no_longer_provoked.empty()) continue;
        ++unprovoked;
        console.always("reproduce: shadowproof verify " + scene.name);
    }
    std::string outcome = report.passed ? fmt::format("passed: {} cells", cells)
                                        : fmt::format("failed: {} of {} cells", failing, cells);
    if (unread > 0) outcome += fmt::format(", {} scenes that could not be tried", unread);
    if (unprovoked > 0) outcome += fmt::format(", {} scenes that stopped provoking", unprovoked);
    console.always(fmt::format("{}; report in {}", outcome,
                               (std::filesystem::path(options.out) / "index.html").string()));
}

int verify(const VerifyOptions& options) {
    const Stopwatch run;
    Console console(options.quiet);
    // The outputs are refused before the work is done, not after.
    ReportFolder folder(options.out);
    Gpu gpu(options.technique.platform);
    Report report;
    report.version = SHADOWPROOF_VERSION;
    report.gl = gpu.driver();
    report.embree = embree_version();
    report.arguments = settings(options.scene, options.technique);
    report.gate = options.gate;
    if (options.gate == Gate::differences) {
        report.arguments.emplace_back("--gate");
        report.arguments.emplace_back("differences");
    }
    for (const std::string& argument : scenes_to_verify(options)) {
        SceneResult& result = report.scenes.emplace_back();
        result.argument = argument;
        result.name = std::filesystem::path(argument).stem().string();
        result.file = argument;
        try {
            verify_scene(options, result, gpu, console, report.report_milliseconds);
        } catch (const Error& error) {
            result.error = error.what();
            result.cells.clear();
            fmt::print(stderr, "shadowproof: {}\n", error.what());
        }
        result.folder = unique_folder(report, result);
        console.progress(fmt::format("{}: writing pictures", result.name));
        const Stopwatch stopwatch;
        folder.add_pictures(result, options.scene.threads);
        report.report_milliseconds += stopwatch.milliseconds();
        drop_pictures(result);
    }
    report.passed =
        std::none_of(report.scenes.begin(), report.scenes.end(),
                     [&](const SceneResult& scene) { return fails(scene, options.gate); });
    report.milliseconds = run.milliseconds();
    folder.finish(report);
    if (!options.json.empty()) write_file(options.json, to_json(report));
    if (!options.junit.empty()) write_file(options.junit, to_junit(report));
    conclude(console, report, options);
    return exit_code(report);
}

} // namespace

Work add_verify(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("verify", "Every technique against the truth; a report of the pixels");
    const auto options = std::make_shared<VerifyOptions>();
    command
        ->add_option("SCENE", options->scenes,
                     "Bundled names, or paths to .gltf or .glb (all bundled scenes)")
        ->check(not_empty());
    add_technique_flags(*command, options->technique);
    add_scene_flags(*command, options->scene);
    command->add_option("--out", options->out, "Folder of the report (report)")
        ->type_name("DIR")
        ->check(not_empty());
    command->add_option("--json", options->json, "Also write the results here")
        ->type_name("FILE")
        ->check(not_empty());
    command->add_option("--junit", options->junit, "Also write JUnit XML here")
        ->type_name("FILE")
        ->check(not_empty());
    command
        ->add_option_function<std::string>(
            "--gate",
            [options](const std::string& text) {
                if (text != "defects" && text != "differences")
                    throw CLI::ValidationError(
                        "--gate", "'" + text + "' is not known; give defects or differences");
                options->gate = text == "defects" ? Gate::defects : Gate::differences;
            },
            "Fail on defects, or on all differences beyond edges (defects)")
        ->type_name("GATE");
    command->add_flag("-q,--quiet", options->quiet, "Only what failed, and the end");
    return [options] { return verify(*options); };
}

} // namespace shadowproof
