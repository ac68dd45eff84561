#include "compare/command/check/check_scene.h"

#include "compare/classify.h"
#include "compare/command/check/pictures.h"
#include "compare/command/check/renderer.h"
#include "compare/command/check/run_controls.h"
#include "compare/command/pieces/report_archive.h"
#include "compare/command/scene_result.h"
#include "compare/families.h"
#include "compare/memory.h"
#include "compare/picture/alignment.h"
#include "compare/picture/diagnosis.h"
#include "compare/picture/reading/shadow_classes.h"
#include "compare/picture/reading/twin_order.h"
#include "compare/picture/regions.h"
#include "scenes/error.h"
#include "scenes/load/catalog.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

namespace shadowproof {

namespace {

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

nlohmann::ordered_json regions_json(const std::vector<WrongRegion>& regions) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const WrongRegion& region : regions)
        list.push_back({{"pixels", region.pixels},
                        {"left", region.left},
                        {"top", region.top},
                        {"right", region.right},
                        {"bottom", region.bottom},
                        {"receiver", region.receiver},
                        {"caster", region.caster},
                        {"words", region.words}});
    return list;
}

/// 1 where a pixel is wrong.
Image<std::uint8_t> wrong_pixels(const Comparison& comparison) {
    Image<std::uint8_t> wrong(comparison.cause.width, comparison.cause.height);
    std::transform(comparison.cause.pixels.begin(), comparison.cause.pixels.end(),
                   wrong.pixels.begin(), [](std::uint8_t cause) {
                       return cause == static_cast<std::uint8_t>(Cause::unexplained) ? 1 : 0;
                   });
    return wrong;
}

/// A picture's cell before it is judged.
Cell begin_cell(const CheckOptions& options, const SceneInputs& inputs, std::size_t i,
                const PictureSize& size, const std::vector<Cell>& cells) {
    Cell cell;
    cell.technique = cell_name(inputs.pictures[i], cells);
    cell.family = "picture";
    cell.command = {"check", inputs.scene};
    if (options.renderer.empty()) {
        cell.summary = "the picture " + inputs.pictures[i];
        cell.command.push_back(inputs.pictures[i]);
        if (!inputs.mask.empty()) cell.command.insert(cell.command.end(), {"--mask", inputs.mask});
        if (!inputs.unlit.empty())
            cell.command.insert(cell.command.end(), {"--unlit", inputs.unlit});
        if (!inputs.unshadowed.empty())
            cell.command.insert(cell.command.end(), {"--unshadowed", inputs.unshadowed});
    } else {
        cell.summary = "the picture that " + options.name + " made: " + options.renderer;
        cell.command.insert(cell.command.end(), {"--renderer", options.renderer});
        if (options.name != usual_name)
            cell.command.insert(cell.command.end(), {"--name", options.name});
    }
    SceneOptions view = options.view;
    view.size = size;
    for (const std::string& word : settings(view, {})) cell.command.push_back(word);
    if (!options.alignment) cell.command.emplace_back("--no-alignment");
    return cell;
}

/// A picture that was judged.
struct Judged {
    Cell cell{};
    std::vector<std::string> said{};     ///< a line per diagnosis
    std::vector<std::string> rest{};     ///< a line per region that is left
    std::vector<std::string> controls{}; ///< lines on negative controls
};

SHADOWPROOF_SEND_ALL(Judged, cell, said, rest, controls)

PictureFiles files_of(const SceneInputs& inputs, std::size_t i) {
    return {inputs.pictures[i], inputs.mask, inputs.unlit, inputs.unshadowed};
}

/// Nothing wrong is no agreement where most pixels are undecidable. `wrong`: 1 where a pixel is.
void require_decided(const Frame& frame, const Image<std::uint8_t>& wrong,
                     const SceneInputs& inputs, std::size_t i) {
    const std::vector<std::uint8_t>& flags = frame.pictured->decided.pixels;
    const auto decided =
        static_cast<std::uint64_t>(std::count(flags.begin(), flags.end(), std::uint8_t{1}));
    const std::uint64_t undecidable = frame.pictured->undecidable;
    if (undecidable <= decided ||
        std::find(wrong.pixels.begin(), wrong.pixels.end(), 1) != wrong.pixels.end())
        return;
    throw Error(inputs.pictures[i],
                fmt::format("tells light from shadow at {} of {} pixels that face the light",
                            grouped(decided), grouped(decided + undecidable)),
                advice_on_undecidable(files_of(inputs, i)));
}

/// The picture and its twins are of the scene's view.
void require_aligned(const TracedScene& traced, const SceneInputs& inputs, std::size_t i,
                     const Pictures& pictures) {
    const auto require = [&](const std::string& file, const Picture& picture, Shows shows) {
        if (const auto words = misalignment(traced, picture, shows))
            throw Error(file, *words,
                        "render it from the scene's camera, or tell where it was seen from by "
                        "--camera-matrix, --fov and --ortho; --no-alignment judges it as it is");
    };
    const Twins& twins = pictures.twins;
    require(inputs.pictures[i], pictures.pictures[i], Shows::shadows);
    if (twins.unlit) require(inputs.unlit, *twins.unlit, Shows::no_shadows);
    if (twins.unshadowed) require(inputs.unshadowed, *twins.unshadowed, Shows::no_shadows);
}

/// The twins are of this picture: one is darker, the other brighter.
void require_order(const GroundTruth& truth, const SceneInputs& inputs, std::size_t i,
                   const Pictures& pictures) {
    const Picture& picture = pictures.pictures[i];
    const Twins& twins = pictures.twins;
    const double step = step_of(picture, twins);
    const auto require = [&](const std::string& file, double wrong, const char* words,
                             const char* remedy) {
        if (wrong > most_in_wrong_order)
            throw Error(file,
                        fmt::format("{} {} in {:.0f} % of what is seen", words, inputs.pictures[i],
                                    100 * wrong),
                        std::string("render both of the same scene and view, with the same "
                                    "exposure") +
                            remedy + "; --no-alignment judges them as they are");
    };
    if (twins.unlit)
        require(inputs.unlit, share_in_wrong_order(truth, *twins.unlit, picture, step),
                "lacks light, but is brighter than",
                " (--unshadowed takes one with the light but without shadows)");
    if (twins.unshadowed)
        require(inputs.unshadowed, share_in_wrong_order(truth, picture, *twins.unshadowed, step),
                "lacks shadows, but is darker than", " (--unlit takes one without the light)");
}

/// No wrong pixel of a picture is excused.
void judge_picture(const CheckOptions& options, const SceneInputs& inputs,
                   const TracedScene& traced, std::size_t i, const Pictures& pictures,
                   Console& console, Judged& judged) {
    auto& [cell, said, rest, controls] = judged;
    try {
        if (options.alignment && inputs.mask.empty()) {
            console.progress(cell.technique + ": alignment");
            require_aligned(traced, inputs, i, pictures);
            require_order(traced.truth(), inputs, i, pictures);
        }
        cell.frame =
            read_shadows(traced, files_of(inputs, i), pictures.pictures[i], pictures.twins);
        const std::unique_ptr<Judge> family = judge_of(traced, cell.frame);
        cell.comparison = classify(traced, cell.frame, *family);
        cell.verdict = judge(traced.scene(), {}, {}, cell.comparison);
        Diagnosed diagnosed{{}, wrong_pixels(cell.comparison)};
        require_decided(cell.frame, diagnosed.left, inputs, i);
        if (options.diagnosis) {
            console.progress(cell.technique + ": diagnosis");
            diagnosed = diagnose(traced, cell.frame, cell.comparison.cause);
        }
        constexpr std::size_t most_regions = 3;
        const std::vector<WrongRegion> regions =
            largest_regions(traced, cell.frame, diagnosed.left, most_regions);
        auto results = nlohmann::ordered_json::parse(cell.comparison.summary.results);
        results["diagnosis"] = diagnosis_json(diagnosed.hypotheses);
        if (!regions.empty()) results["regions"] = regions_json(regions);
        if (options.controls) {
            console.progress(cell.technique + ": negative controls");
            const auto outcomes = run_controls(traced, cell.frame, options.gate.gate);
            results["controls"] = controls_json(outcomes);
            controls = controls_lines(outcomes);
        }
        cell.comparison.summary.results = results.dump();
        for (const Diagnosis& each : diagnosed.hypotheses)
            said.push_back(fmt::format("{}: {}: explains {} wrong pixels, contradicts {}",
                                       each.hypothesis, each.words, grouped(each.explained),
                                       grouped(each.contradicted)));
        for (const WrongRegion& region : regions) rest.push_back(region.words);
    } catch (const Error& error) {
        cell.error = as_in_report(error.what(), inputs.work);
    }
}

/// Judges a picture and writes what the report shows of it, as a piece. One that is lost has a cell
/// that says so.
Judged check_picture(const CheckWork& work, const TracedScene& traced, const SceneResult& result,
                     const Pictures& pictures, std::size_t i) {
    const CheckOptions& options = work.options;
    const Cell begun = begin_cell(options, work.inputs, i, pictures.size, result.cells);
    if (const std::size_t count = work.inputs.pictures.size(); count > 1)
        work.console.begin_part(fmt::format("picture {} of {}: ", i + 1, count));
    work.console.progress(begun.technique + ": judging");
    try {
        bool by_this_worker = false;
        Judged done = work.pieces.piece(begun.technique, [&] {
            by_this_worker = true;
            Judged judged{.cell = begun};
            judge_picture(options, work.inputs, traced, i, pictures, work.console, judged);
            Cell& cell = judged.cell;
            if (work.baseline && cell.error.empty()) compare_with(*work.baseline, result, cell);
            if (cell.error.empty()) cell.first_failing = first_that_fails(cell, options.gate.gate);
            work.console.progress(cell.technique + ": writing");
            work.folder.add_cell(result, cell, options.view.threads);
            return judged;
        });
        if (!by_this_worker) work.folder.recall_cell(result, done.cell);
        return done;
    } catch (const LostPiece& lost) {
        Judged judged{.cell = begun};
        judged.cell.error = lost.what();
        if (lost.loss == Loss::timed_out) judged.cell.verdict = Verdict::timed_out;
        return judged;
    }
}

void announce(const CheckWork& work, const Scene& scene) {
    work.console.heading(scene.name);
    work.console.notes(scene.notes, work.options.output.verbose);
    std::vector<std::string> inputs = work.inputs.pictures;
    inputs.insert(inputs.end(), {work.inputs.mask, work.inputs.unlit, work.inputs.unshadowed});
    for (const std::string& file : inputs)
        if (const std::string kind = extension_of(file); kind == ".jpg" || kind == ".jpeg")
            work.console.line(fmt::format("  note: {}: JPEG loses what tells light from shadow at "
                                          "outlines; render a PNG or EXR",
                                          file));
}

} // namespace

SceneResult check_scene(const CheckWork& work) {
    const CheckOptions& options = work.options;
    Console& console = work.console;
    const Pictures pictures =
        read_pictures(options, work.inputs, work.memory, console, work.pieces);
    const MemoryBudget budget = work.memory.left();
    require_picture(budget, pictures.size.width, pictures.size.height, Workload::comparison);
    SceneOptions view = drawn_by_others(options.view);
    view.size = pictures.size;
    view.size_given = true;
    console.progress(work.inputs.scene + ": reading");
    const Scene scene = work.pieces.step(work.inputs.scene + ": reading", [&] {
        SceneRequest request = view.request();
        request.normals = true; // engines shade by them
        return load_scene(work.inputs.scene, request);
    });
    require_scene(budget, scene, Workload::comparison);
    SceneResult result;
    result.argument = work.inputs.scene;
    result.name = unique_name(work.done, scene.name);
    describe(result, scene);
    console.progress(work.inputs.scene + ": tracing");
    const Tracer tracer = work.pieces.step(work.inputs.scene + ": tracing", [&] {
        Tracer made(scene, options.view.threads);
        result.truth = trace(made);
        return made;
    });
    if (result.truth.statistics.lit == 0 || result.truth.statistics.shadowed == 0)
        throw Error(work.inputs.scene,
                    result.truth.statistics.lit == 0 ? "shows no pixel in light"
                                                     : "shows no pixel in shadow",
                    "turn the camera, or choose another light: nothing can be told by this view");
    const TracedScene traced(tracer, result.truth);
    announce(work, scene);
    work.pieces.piece(work.inputs.scene + ": writing", [&] {
        work.folder.add_scene(result);
        return true;
    });
    for (std::size_t i = 0; i < pictures.pictures.size(); ++i) {
        Judged judged = check_picture(work, traced, result, pictures, i);
        console.cell(result, judged.cell, {}, fails(judged.cell, options.gate.gate));
        console.cell_details(judged.cell, options.gate.gate);
        for (const std::string& line : judged.said) console.always("  diagnosis: " + line);
        for (const std::string& line : judged.rest) console.always("  left: " + line);
        for (const std::string& line : judged.controls) console.line("  " + line);
        result.cells.push_back(std::move(judged.cell));
    }
    return result;
}

} // namespace shadowproof
