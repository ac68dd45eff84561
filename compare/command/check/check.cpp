#include "compare/classify.h"
#include "compare/command/commands.h"
#include "compare/command/guard.h"
#include "compare/command/outcome.h"
#include "compare/command/pieces/report_archive.h"
#include "compare/command/pieces/supervisor.h"
#include "compare/command/process/stopwatch.h"
#include "compare/command/scene_result.h"
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
    double timeout =
        usual_timeout; ///< seconds for a picture, or for tracing the scene; 0: no limit
};

/// What is to be judged: the picture, or the mask that goes with it.
const std::string& judged_file(const CheckOptions& options, std::size_t i) {
    return options.mask.empty() ? options.pictures[i] : options.mask;
}

/// Its pixels stay in the account.
Picture read(const std::string& file, MemoryAccount& memory) {
    constexpr std::uint64_t most_pixels = std::uint64_t{1} << 28;
    Picture picture = read_picture(file, {.memory = memory, .most_pixels = most_pixels});
    memory.keep({picture.values.size() * sizeof(float), file, "its pixels",
                 "check fewer pictures at once"});
    return picture;
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

/// A picture's cell before it is judged.
Cell begin_cell(const CheckOptions& options, std::size_t i, const PictureSize& size,
                const std::vector<Cell>& cells) {
    Cell cell;
    cell.technique = cell_name(options.pictures[i], cells);
    cell.family = "picture";
    cell.summary = "the picture " + options.pictures[i];
    cell.command = {"check", options.scene, options.pictures[i]};
    if (!options.mask.empty()) cell.command.insert(cell.command.end(), {"--mask", options.mask});
    if (!options.unlit.empty()) cell.command.insert(cell.command.end(), {"--unlit", options.unlit});
    SceneOptions view = options.view;
    view.size = size;
    for (const std::string& word : settings(view, {})) cell.command.push_back(word);
    return cell;
}

/// The pictures that are judged, and the one without the light.
struct Pictures {
    std::vector<Picture> pictures{};
    std::optional<Picture> twin{};
    PictureSize size{};
};

Pictures read_pictures(const CheckOptions& options, MemoryAccount& memory, Console& console,
                       Pieces& pieces) {
    const auto read_one = [&](const std::string& file) {
        console.progress(file + ": reading");
        return pieces.step(file + ": reading", [&] { return read(file, memory); });
    };
    Pictures all;
    for (std::size_t i = 0; i < options.pictures.size(); ++i)
        all.pictures.push_back(read_one(judged_file(options, i)));
    const PictureSize first{all.pictures.front().width, all.pictures.front().height};
    all.size = options.with_size ? options.view.size : first;
    const auto [width, height] = all.size;
    for (std::size_t i = 0; i < all.pictures.size(); ++i)
        require_size(judged_file(options, i), all.pictures[i], width, height);
    if (options.unlit.empty()) return all;
    all.twin = read_one(options.unlit);
    require_size(options.unlit, *all.twin, width, height);
    return all;
}

/// A picture that was judged.
struct Judged {
    Cell cell{};
    std::vector<std::string> said{}; ///< a line per diagnosis
};

SHADOWPROOF_SEND_ALL(Judged, cell, said)

/// No wrong pixel of a picture is excused.
void judge_picture(const CheckOptions& options, const TracedScene& traced, std::size_t i,
                   const Pictures& pictures, Console& console, Judged& judged) {
    auto& [cell, said] = judged;
    try {
        cell.frame = read_shadows(traced, {options.pictures[i], options.mask, options.unlit},
                                  pictures.pictures[i], pictures.twin);
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
}

/// What a worker is given.
struct CheckWork {
    const CheckOptions& options;
    const std::optional<ResultsFile>& baseline;
    MemoryAccount& memory;
    Console& console;
    const ReportFolder& folder;
    Pieces& pieces;
};

/// Judges a picture and writes what the report shows of it, as a piece. One that is lost has a cell
/// that says so.
Judged check_picture(const CheckWork& work, const TracedScene& traced, const SceneResult& result,
                     const Pictures& pictures, std::size_t i) {
    const CheckOptions& options = work.options;
    const Cell begun = begin_cell(options, i, pictures.size, result.cells);
    work.console.progress(begun.technique + ": judging");
    try {
        return work.pieces.piece(begun.technique, [&] {
            Judged judged{.cell = begun};
            judge_picture(options, traced, i, pictures, work.console, judged);
            Cell& cell = judged.cell;
            if (work.baseline && cell.error.empty()) compare_with(*work.baseline, result, cell);
            if (cell.error.empty()) cell.first_failing = first_that_fails(cell, options.gate.gate);
            work.console.progress(cell.technique + ": writing");
            work.folder.add_cell(result, cell, options.view.threads);
            return judged;
        });
    } catch (const LostPiece& lost) {
        Judged judged{.cell = begun};
        judged.cell.error = lost.what();
        if (lost.loss == Loss::timed_out) judged.cell.verdict = Verdict::timed_out;
        return judged;
    }
}

void announce(const CheckWork& work, const Scene& scene) {
    const CheckOptions& options = work.options;
    work.console.heading(scene.name);
    for (const std::string& note : scene.notes) work.console.line("  note: " + note);
    std::vector<std::string> inputs = options.pictures;
    inputs.insert(inputs.end(), {options.mask, options.unlit});
    for (const std::string& file : inputs)
        if (const std::string kind = extension_of(file); kind == ".jpg" || kind == ".jpeg")
            work.console.line(fmt::format("  note: {}: JPEG loses what tells light from shadow at "
                                          "outlines; render a PNG or EXR",
                                          file));
}

/// The work of a worker: the scene with a cell for each picture.
SceneResult check_pictures(const CheckWork& work) {
    const CheckOptions& options = work.options;
    Console& console = work.console;
    const Pictures pictures = read_pictures(options, work.memory, console, work.pieces);
    const MemoryBudget budget = work.memory.left();
    require_picture(budget, pictures.size.width, pictures.size.height, Workload::comparison);
    SceneOptions view = options.view;
    view.size = pictures.size;
    view.size_given = true;
    // Other renderers draw what is in the file.
    view.floor = view.floor.value_or(false);
    console.progress(options.scene + ": reading");
    const Scene scene = work.pieces.step(options.scene + ": reading",
                                         [&] { return load_scene(options.scene, view.request()); });
    require_scene(budget, scene, Workload::comparison);
    SceneResult result;
    result.argument = options.scene;
    result.name = scene.name;
    describe(result, scene);
    console.progress(options.scene + ": tracing");
    const Tracer tracer = work.pieces.step(options.scene + ": tracing", [&] {
        Tracer made(scene, options.view.threads);
        result.truth = trace(made);
        return made;
    });
    if (result.truth.statistics.lit == 0 || result.truth.statistics.shadowed == 0)
        throw Error(options.scene,
                    result.truth.statistics.lit == 0 ? "shows no pixel in light"
                                                     : "shows no pixel in shadow",
                    "turn the camera, or choose another light: nothing can be told by this view");
    const TracedScene traced(tracer, result.truth);
    announce(work, scene);
    work.pieces.piece(options.scene + ": writing", [&] {
        work.folder.add_scene(result);
        return true;
    });
    for (std::size_t i = 0; i < pictures.pictures.size(); ++i) {
        Judged judged = check_picture(work, traced, result, pictures, i);
        console.cell(result, judged.cell, {}, fails(judged.cell, options.gate.gate));
        for (const std::string& line : judged.said) console.always("  diagnosis: " + line);
        result.cells.push_back(std::move(judged.cell));
    }
    return result;
}

int check(const CheckOptions& options, double waited, int watcher) {
    const Stopwatch stopwatch;
    const std::string started = timestamp_now();
    Console console(options.output.quiet, watcher);
    MemoryAccount memory(options.view.memory);
    std::vector<std::string> inputs = options.pictures;
    inputs.insert(inputs.end(), {options.scene, options.mask, options.unlit});
    check_outputs(options.output, inputs);
    std::optional<ResultsFile> baseline;
    if (!options.gate.baseline.empty()) baseline = read_results(options.gate.baseline, &memory);
    ReportFolder folder(options.output.out);
    Report report;
    report.version = SHADOWPROOF_VERSION;
    report.gl = {"none", "none", DepthModel{}.subpixel_bits, 0, 0};
    report.gate = options.gate.gate;
    report.scenes.push_back(
        supervised({.timeout = options.timeout, .console = console}, [&](Pieces& pieces) {
            return check_pictures({options, baseline, memory, console, folder, pieces});
        }));
    report.embree = embree_version(); // starts Embree: no worker is started any more
    console.progress("writing " + options.output.out);
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
    add_timeout_flag(*command, options->timeout,
                     "Seconds for a picture, and for reading or tracing the scene, above which it "
                     "is given up (600; 0: any number)");
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
        return guarded([&](int watcher) { return check(*options, waited, watcher); },
                       options->output.out);
    };
}

} // namespace shadowproof
