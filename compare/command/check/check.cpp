#include "compare/classify.h"
#include "compare/command/commands.h"
#include "compare/command/guard.h"
#include "compare/command/outcome.h"
#include "compare/command/scene_result.h"
#include "compare/command/stopwatch.h"
#include "compare/families.h"
#include "compare/memory.h"
#include "compare/picture/diagnosis.h"
#include "compare/picture/shadow_classes.h"
#include "compare/results/baseline.h"
#include "scenes/error.h"
#include "scenes/load/catalog.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

namespace shadowproof {

namespace {

struct CheckOptions {
    std::string scene;
    std::vector<std::string> pictures;
    std::string mask; ///< empty: none
    std::string unlit;
    SceneOptions view;
    bool with_size = false; ///< --size was given; else the pictures' own
    GateOptions gate;
    OutputOptions output;
    bool diagnosis = true;
};

/// What is to be judged: the picture, or the mask that goes with it.
const std::string& judged_file(const CheckOptions& options, std::size_t i) {
    return options.mask.empty() ? options.pictures[i] : options.mask;
}

Picture read(const std::string& file, const MemoryAccount& memory) {
    constexpr std::uint64_t most_pixels = std::uint64_t{1} << 28;
    return read_picture(file, {.memory = memory, .most_pixels = most_pixels});
}

void require_size(const std::string& file, const Picture& picture, int width, int height) {
    if (picture.width == width && picture.height == height) return;
    throw Error(
        file,
        fmt::format("is {}x{}, where {}x{} belongs", picture.width, picture.height, width, height),
        "render all pictures of a scene at one size, or check them one by one");
}

/// A name that a folder may have: the picture's own, but for other characters.
std::string cell_name(const std::string& file, const std::vector<Cell>& cells) {
    std::string stem = std::filesystem::path(file).stem().string();
    for (char& c : stem) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                           (c >= '0' && c <= '9') || c == '-' || c == '_';
        if (!plain) c = '_';
    }
    if (stem.empty()) stem = "picture";
    std::string name = stem;
    const auto is_taken = [&] {
        return std::any_of(cells.begin(), cells.end(),
                           [&](const Cell& cell) { return cell.technique == name; });
    };
    for (int number = 2; is_taken(); ++number) name = fmt::format("{}-{}", stem, number);
    return name;
}

nlohmann::ordered_json diagnosis_json(const std::vector<Diagnosis>& diagnoses) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Diagnosis& each : diagnoses) {
        nlohmann::ordered_json parameters = nlohmann::ordered_json::object();
        for (const auto& [name, value] : each.parameters) parameters[name] = value;
        list.push_back({{"hypothesis", each.hypothesis},
                        {"parameters", parameters},
                        {"explained", each.explained},
                        {"contradicted", each.contradicted},
                        {"words", each.words}});
    }
    return list;
}

/// No wrong pixel of a picture is excused. `said`: gets a line per diagnosis.
Cell judge_picture(const CheckOptions& options, const TracedScene& traced, std::size_t i,
                   const Picture& picture, const std::optional<Picture>& twin,
                   const std::vector<Cell>& cells, Console& console,
                   std::vector<std::string>& said) {
    Cell cell;
    cell.technique = cell_name(options.pictures[i], cells);
    cell.family = "picture";
    cell.summary = "the picture " + options.pictures[i];
    cell.command = {"check", options.scene, options.pictures[i]};
    if (!options.mask.empty()) cell.command.insert(cell.command.end(), {"--mask", options.mask});
    if (!options.unlit.empty()) cell.command.insert(cell.command.end(), {"--unlit", options.unlit});
    SceneOptions view = options.view;
    view.size = {picture.width, picture.height};
    for (const std::string& word : settings(view, {})) cell.command.push_back(word);
    try {
        cell.frame =
            read_shadows(traced, {options.pictures[i], options.mask, options.unlit}, picture, twin);
        const std::unique_ptr<Judge> family = judge_of(traced, cell.frame);
        cell.comparison = classify(traced, cell.frame, *family);
        cell.verdict = judge(traced.scene(), {}, {}, cell.comparison);
        std::vector<Diagnosis> diagnoses;
        if (options.diagnosis) {
            console.progress(cell.technique + ": diagnosis");
            diagnoses = diagnose(traced, cell.frame, cell.comparison.cause);
        }
        auto results = nlohmann::ordered_json::parse(cell.comparison.summary.results);
        results["diagnosis"] = diagnosis_json(diagnoses);
        cell.comparison.summary.results = results.dump();
        for (const Diagnosis& each : diagnoses)
            said.push_back(fmt::format("{}: {}: explains {} wrong pixels, contradicts {}",
                                       each.hypothesis, each.words, grouped(each.explained),
                                       grouped(each.contradicted)));
    } catch (const Error& error) {
        cell.error = error.what();
    }
    return cell;
}

int check(const CheckOptions& options, double waited) {
    const Stopwatch stopwatch;
    const std::string started = timestamp_now();
    Console console(options.output.quiet);
    const MemoryBudget& budget = options.view.memory;
    MemoryAccount memory(budget);
    std::vector<std::string> inputs = options.pictures;
    inputs.insert(inputs.end(), {options.scene, options.mask, options.unlit});
    check_outputs(options.output, inputs);
    std::optional<ResultsFile> baseline;
    if (!options.gate.baseline.empty()) baseline = read_results(options.gate.baseline, &memory);

    std::vector<Picture> pictures;
    for (std::size_t i = 0; i < options.pictures.size(); ++i)
        pictures.push_back(read(judged_file(options, i), memory));
    const PictureSize first{pictures.front().width, pictures.front().height};
    const auto [width, height] = options.with_size ? options.view.size : first;
    for (std::size_t i = 0; i < pictures.size(); ++i)
        require_size(judged_file(options, i), pictures[i], width, height);
    std::optional<Picture> twin;
    if (!options.unlit.empty()) {
        twin = read(options.unlit, memory);
        require_size(options.unlit, *twin, width, height);
    }
    require_picture(budget, width, height, Workload::comparison);
    SceneOptions view = options.view;
    view.size = {width, height};
    const Scene scene = load_scene(options.scene, view.request());
    require_scene(budget, scene, Workload::comparison);

    ReportFolder folder(options.output.out);
    Report report;
    report.version = SHADOWPROOF_VERSION;
    report.embree = embree_version();
    report.gl = {"none", "none", DepthModel{}.subpixel_bits, 0, 0};
    report.gate = options.gate.gate;
    SceneResult& result = report.scenes.emplace_back();
    result.argument = options.scene;
    result.name = scene.name;
    describe(result, scene);
    const Tracer tracer(scene, options.view.threads);
    result.truth = trace(tracer);
    if (result.truth.statistics.lit == 0 || result.truth.statistics.shadowed == 0)
        throw Error(options.scene,
                    result.truth.statistics.lit == 0 ? "shows no pixel in light"
                                                     : "shows no pixel in shadow",
                    "turn the camera, or choose another light: nothing can be told by this view");
    const TracedScene traced(tracer, result.truth);
    console.heading(scene.name);
    for (const std::string& note : scene.notes) console.line("  note: " + note);
    for (const std::string& file : inputs)
        if (const std::string kind = extension_of(file); kind == ".jpg" || kind == ".jpeg")
            console.line(fmt::format("  note: {}: JPEG loses what tells light from shadow at "
                                     "outlines; render a PNG or EXR",
                                     file));
    folder.add_scene(result);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        std::vector<std::string> said;
        Cell cell =
            judge_picture(options, traced, i, pictures[i], twin, result.cells, console, said);
        if (baseline && cell.error.empty()) compare_with(*baseline, result, cell);
        if (cell.error.empty()) cell.first_failing = first_that_fails(cell, report.gate);
        console.cell(result, cell, {}, fails(cell, report.gate));
        for (const std::string& line : said) console.always("  diagnosis: " + line);
        folder.add_cell(result, cell, options.view.threads);
        result.cells.push_back(std::move(cell));
    }
    console.clear_progress();
    report.milliseconds = waited + stopwatch.milliseconds();
    return end_run(folder, console, report, options.gate, baseline, options.output, started);
}

} // namespace

Work add_check(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("check", "Pictures that a renderer made of a scene, against the truth");
    const auto options = std::make_shared<CheckOptions>();
    add_scene_argument(*command, options->scene);
    command
        ->add_option("IMAGE", options->pictures,
                     "Pictures of that view: .png, .jpg or .exr, all of one size")
        ->required()
        ->check(not_empty());
    CLI::Option* mask =
        command
            ->add_option("--mask", options->mask,
                         "The picture's shadows: black where shadowed, white where lit")
            ->type_name("IMAGE")
            ->check(not_empty());
    command
        ->add_option("--unlit", options->unlit,
                     "The same view without the light: what differs from it is lit")
        ->type_name("IMAGE")
        ->check(not_empty())
        ->excludes(mask);
    command->add_flag("!--no-diagnosis", options->diagnosis, "Do not ask why pixels are wrong");
    add_scene_flags(*command, options->view);
    add_gate_flags(*command, options->gate);
    add_output_flags(*command, options->output);
    command->final_callback([options, command] {
        options->with_size = command->get_option("--size")->count() > 0;
        if (!options->mask.empty() && options->pictures.size() > 1)
            throw CLI::ValidationError("--mask",
                                       "is of one picture; check the others by themselves");
        if (!options->unlit.empty() && options->pictures.size() > 1)
            throw CLI::ValidationError("--unlit",
                                       "is of one picture; check the others by themselves");
    });
    return [options] {
        const double waited = milliseconds_since_start_of_process().value_or(0);
        return guarded([&] { return check(*options, waited); }, options->output.out);
    };
}

} // namespace shadowproof
