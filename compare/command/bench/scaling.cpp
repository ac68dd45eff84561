#include "compare/command/bench/scaling.h"

#include "compare/bench/bench_table.h"
#include "compare/command/bench/measured_archive.h"
#include "compare/command/bench/sweep.h"
#include "compare/command/process/standard_output.h"
#include "compare/command/process/stopwatch.h"
#include "compare/families.h"
#include "compare/memory.h"
#include "compare/report/escape.h"
#include "compare/words.h"
#include "raster/render.h"
#include "reference/predict/region_ledger.h"
#include "reference/trace/trace.h"
#include "scenes/error.h"
#include "scenes/generated.h"
#include "scenes/load/catalog.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <optional>
#include <utility>

namespace shadowproof {

namespace {

/// What grows. A line of the table below for each.
struct Axis {
    const char* name;
    std::vector<int> sizes; ///< as `scenes` takes them
    std::size_t quick;      ///< so many of the sizes with --quick
    /// The size that is shown and fitted.
    double (*value)(const Tracer& tracer, int size);
    /// What is drawn for a sample, one after the other.
    std::vector<Scene> (*scenes)(const BenchOptions& options, int size);
    /// The flag that takes the size; techniques that do not heed it are left out. Null: none does.
    const char* flag = nullptr;
};

double as_it_is(const Tracer& /*tracer*/, int size) {
    return size;
}

double squared(const Tracer& /*tracer*/, int side) {
    return static_cast<double>(side) * side;
}

double silhouette_edges(const Tracer& tracer, int /*size*/) {
    return static_cast<double>(Silhouette(tracer).sides().size());
}

std::string named_scene(const BenchOptions& options) {
    return options.scenes.empty() ? "ordinary" : options.scenes.front();
}

template <Scene (*generate)(int size, int width, int height)>
std::vector<Scene> generated(const BenchOptions& options, int size) {
    return {generate(size, options.scene.size.width, options.scene.size.height)};
}

std::vector<Axis> axes() {
    return {{"pixels",
             {64, 128, 256, 512, 1024, 2048, 4096},
             4,
             squared,
             [](const BenchOptions& options, int side) {
                 SceneRequest request = options.scene.request();
                 request.width = side;
                 request.height = side;
                 request.camera_aspect = false;
                 return std::vector{load_scene(named_scene(options), request)};
             }},
            {"triangles",
             {1'000, 4'000, 16'000, 64'000, 256'000, 1'000'000, 4'000'000},
             4,
             as_it_is,
             generated<dense_scene>},
            {"volumes", {1, 2, 4, 8, 16, 32, 64}, 5, as_it_is, generated<stacked_scene>},
            {"silhouette edges",
             {1, 4, 16, 64, 256, 1024},
             4,
             silhouette_edges,
             generated<parted_scene>},
            {"lights",
             {1, 2, 4, 8, 16, 32, 64},
             4,
             as_it_is,
             [](const BenchOptions& options, int lights) {
                 const auto [width, height] = options.scene.size;
                 std::vector<Scene> each(static_cast<std::size_t>(lights),
                                         lit_scene(lights, width, height));
                 for (std::size_t i = 0; i < each.size(); ++i) each[i].light = i;
                 return each;
             }},
            {"texels",
             {64, 128, 256, 512, 1024, 2048, 4096, 8192},
             5,
             squared,
             [](const BenchOptions& options, int /*side*/) {
                 return std::vector{load_scene(named_scene(options), options.scene.request())};
             },
             "map-size"}};
}

/// What is measured along an axis, and whether it still is.
struct Runner {
    const Technique* technique; ///< null: the truth
    Growth growth;
    bool stopped = false;
    bool crashed = false;
    bool warm = false; ///< at this size, in this process

    /// Whether it is to be measured at the i-th size: an earlier run had some.
    bool lacks(std::size_t i) const { return !stopped && growth.points.size() <= i; }
};

std::vector<Runner> runners_along(const BenchWork& work, const Axis& axis, const Scene& scene) {
    const auto growth = [&](const std::string& technique) {
        std::string command = "shadowproof bench --scaling";
        if (!work.options.scenes.empty())
            command += " " + shell_quoted(work.options.scenes.front());
        if (technique != truth_point) command += " --technique " + technique;
        if (work.options.quick) command += " --quick";
        for (const std::string& word : settings(work.options.scene, work.options.technique))
            command += " " + shell_quoted(word);
        return Growth{.axis = axis.name,
                      .scene = scene.name,
                      .technique = technique,
                      .command = command,
                      .points = {}};
    };
    std::vector<Runner> runners;
    if (axis.flag == nullptr) {
        runners.push_back({nullptr, growth(truth_point)});
        runners.back().growth.family = truth_point;
    }
    for (const Technique* technique : work.options.technique.chosen())
        if (suits(*technique, scene) && (axis.flag == nullptr || heeds(*technique, axis.flag)))
            runners.push_back({technique, growth(std::string(technique->name))});
    return runners;
}

void stop(const BenchWork& work, Runner& runner, const std::string& why, Loss loss = Loss::none) {
    runner.stopped = true;
    work.run.left_out.push_back(
        {runner.growth.scene, runner.growth.technique, {}, why, loss, runner.growth.axis});
}

/// Says once what was lost. The runner goes no further.
void lose(const BenchWork& work, Runner& runner, const std::string& where, const LostPiece& lost) {
    const std::string words = fmt::format("{}: {}", where, lost.what());
    if (!work.pieces.catching_up()) complain(words);
    stop(work, runner, words, lost.loss);
    runner.crashed = runner.crashed || lost.loss == Loss::crashed;
}

/// A scene with what drawing it needs.
struct Drawable {
    const Scene& scene;
    Tracer tracer;
    Plan plan;

    Drawable(const BenchWork& work, const Scene& drawn, const TechniqueSettings& asked)
        : scene(drawn), tracer(drawn, work.options.scene.threads), plan(make_plan(drawn)) {
        plan.asked = asked;
    }
};

/// Milliseconds of a frame.
double draw(const BenchWork& work, Runner& runner, const Drawable& drawable) {
    if (runner.technique == nullptr) return trace(drawable.tracer).statistics.milliseconds;
    const Frame frame = render(*runner.technique, drawable.scene, drawable.plan, work.gpu);
    runner.growth.family = frame.family;
    return frame.milliseconds;
}

/// One size: each runner draws once to warm up, and all are measured in rounds. `place`: "2 of 7".
void measure_size(const BenchWork& work, const Axis& axis, std::vector<Runner>& runners,
                  const std::vector<Scene>& scenes, std::size_t at, const std::string& place) {
    const int size = axis.sizes[at];
    TechniqueOptions options = work.options.technique;
    if (axis.flag != nullptr)
        options = with_settings(options, {{axis.flag, fmt::format("{}", size)}});
    require_memory(work.options.scene.memory, options.asked);
    require_scene(work.options.scene.memory, scenes.front(), Workload::comparison);
    const Drawable first =
        work.pieces.step("tracing", [&] { return Drawable(work, scenes.front(), options.asked); });
    const double value = axis.value(first.tracer, size);
    const std::string where =
        fmt::format("{} {}, {}", grouped(static_cast<std::uint64_t>(value)), axis.name, place);
    const auto draw_all = [&](Runner& runner) {
        double sum = draw(work, runner, first);
        for (std::size_t k = 1; k < scenes.size(); ++k) // one at a time in memory
            sum += draw(work, runner, Drawable(work, scenes[k], options.asked));
        return sum;
    };
    const double most_seconds = work.options.quick ? 0.7 : 4; // of work for a sample
    std::vector<Runner*> drawn;
    for (Runner& runner : runners) {
        if (!runner.lacks(at)) continue;
        runner.warm = false;
        work.console.progress(fmt::format("{}: {}", where, runner.growth.technique));
        try {
            const double seconds = work.pieces.piece(runner.growth.technique + " once", [&] {
                const Stopwatch stopwatch;
                draw_all(runner);
                runner.warm = true;
                return stopwatch.milliseconds() / 1000;
            });
            drawn.push_back(&runner);
            if (seconds > most_seconds)
                stop(work, runner,
                     fmt::format("not measured beyond {}: a sample took {:.1f} s", where, seconds));
        } catch (const LostPiece& lost) {
            lose(work, runner, where, lost);
        } catch (const Error& error) {
            stop(work, runner, error.what());
        }
    }
    const auto sample = [&](Runner& runner) -> std::optional<double> {
        try {
            return work.pieces.piece(runner.growth.technique, [&] {
                if (!runner.warm) draw_all(runner);
                runner.warm = true;
                return draw_all(runner);
            });
        } catch (const LostPiece& lost) {
            lose(work, runner, where, lost);
            return std::nullopt;
        }
    };
    std::vector<std::vector<double>> samples(drawn.size());
    const Stopwatch stopwatch;
    measure_in_rounds(
        samples,
        {.repeats = std::min<std::size_t>(work.options.quick ? 7 : 15, work.options.limits.repeats),
         .seconds = work.options.quick ? 4.0 : 30.0},
        {.measure = [&](std::size_t i) { return sample(*drawn[i]); },
         .seconds = [&] { return stopwatch.milliseconds() / 1000; },
         .before =
             [&](std::size_t i) {
                 work.console.progress(fmt::format("{}: {}, sample {}", where,
                                                   drawn[i]->growth.technique,
                                                   samples[i].size() + 1));
             },
         .after_round = [] {}});
    for (std::size_t i = 0; i < drawn.size(); ++i)
        if (!samples[i].empty()) drawn[i]->growth.points.push_back({value, samples[i]});
}

/// Each runner begins with the sizes that an earlier run had of it, by the same command, and is
/// stopped where it was. What was lost is tried again.
void take_over(const BenchWork& work, std::vector<Runner>& runners) {
    if (work.kept == nullptr) return;
    for (Runner& runner : runners) {
        Growth& line = runner.growth;
        for (const Growth& known : work.kept->growth)
            if (known.axis == line.axis && known.scene == line.scene &&
                known.technique == line.technique && known.command == line.command)
                line = known;
        for (const BenchLeftOut& out : work.kept->left_out) {
            if (line.points.empty() || out.loss != Loss::none || out.axis != line.axis ||
                out.scene != line.scene || out.technique != line.technique)
                continue;
            runner.stopped = true;
            work.run.left_out.push_back(out);
        }
    }
}

/// What a size results in: where its runners then are.
struct MeasuredSize {
    std::vector<Growth> growth{};
    std::vector<bool> stopped{};
    std::vector<bool> crashed{};
    std::vector<BenchLeftOut> left_out{};
};

SHADOWPROOF_SEND_ALL(MeasuredSize, growth, stopped, crashed, left_out)

/// Measures a size as a piece. `scenes`: empty where they are still to be made.
void measure_as_piece(const BenchWork& work, const Axis& axis, std::vector<Runner>& runners,
                      std::vector<Scene> scenes, std::size_t i, const std::string& place) {
    std::vector<BenchLeftOut>& left_out = work.run.left_out;
    const std::size_t before = left_out.size();
    const MeasuredSize measured = work.pieces.piece(axis.name + (" " + place), [&] {
        if (scenes.empty()) scenes = axis.scenes(work.options, axis.sizes[i]);
        measure_size(work, axis, runners, scenes, i, place);
        MeasuredSize size;
        for (const Runner& runner : runners) {
            size.growth.push_back(runner.growth);
            size.stopped.push_back(runner.stopped);
            size.crashed.push_back(runner.crashed);
        }
        size.left_out.assign(left_out.begin() + static_cast<std::ptrdiff_t>(before),
                             left_out.end());
        return size;
    });
    left_out.resize(before);
    left_out.insert(left_out.end(), measured.left_out.begin(), measured.left_out.end());
    for (std::size_t k = 0; k < runners.size(); ++k) {
        runners[k].growth = measured.growth[k];
        runners[k].stopped = measured.stopped[k];
        runners[k].crashed = measured.crashed[k];
    }
}

/// Puts the lines that have sizes behind the run's first `before` lines.
void put_lines(BenchRun& run, std::size_t before, const std::vector<Runner>& runners) {
    run.growth.resize(before);
    for (const Runner& runner : runners)
        if (!runner.growth.points.empty()) run.growth.push_back(runner.growth);
}

/// Returns whether no worker crashed on the way.
bool measure_axis(const BenchWork& work, const Axis& axis) {
    std::vector<Runner> runners;
    bool crashed = false;
    const std::size_t sizes = work.options.quick ? axis.quick : axis.sizes.size();
    const std::size_t before = work.run.growth.size();
    for (std::size_t i = 0; i < sizes; ++i) {
        const std::string place = fmt::format("{} of {}", i + 1, sizes);
        const std::string where = fmt::format("{} {}", axis.name, place);
        try {
            std::vector<Scene> scenes;
            if (i == 0) {
                scenes = work.pieces.step(where + ": reading",
                                          [&] { return axis.scenes(work.options, axis.sizes[i]); });
                runners = runners_along(work, axis, scenes.front());
                take_over(work, runners);
                put_lines(work.run, before, runners);
            }
            if (std::ranges::none_of(runners, [&](const Runner& each) { return each.lacks(i); }))
                continue;
            measure_as_piece(work, axis, runners, std::move(scenes), i, place);
            put_lines(work.run, before, runners);
            if (!work.pieces.catching_up()) work.keeper.keep(work.run);
        } catch (const std::bad_alloc&) {
            work.run.left_out.push_back(
                {axis.name, {}, {}, where + ": " + out_of_memory, Loss::none, axis.name});
            break;
        } catch (const LostPiece& lost) {
            if (!work.pieces.catching_up()) complain(lost.what());
            work.run.left_out.push_back({axis.name, {}, {}, lost.what(), lost.loss, axis.name});
            crashed = crashed || lost.loss == Loss::crashed;
            break;
        } catch (const Error& error) {
            if (i == 0) throw;
            work.run.left_out.push_back({axis.name, {}, {}, error.what(), Loss::none, axis.name});
            break;
        }
    }
    return !crashed &&
           std::ranges::none_of(runners, [](const Runner& runner) { return runner.crashed; });
}

} // namespace

bool measure_growth(const BenchWork& work) {
    bool complete = true;
    for (const Axis& axis : axes()) {
        try {
            complete = measure_axis(work, axis) && complete;
        } catch (const Error& error) {
            if (!work.pieces.catching_up()) complain(error.what());
            work.run.left_out.push_back({axis.name, {}, {}, error.what(), Loss::none, axis.name});
            complete = false;
        }
        if (!work.pieces.catching_up()) work.keeper.keep(work.run);
    }
    work.console.clear_progress();
    for (const std::string& line : growth_table(work.run)) work.console.line(line);
    for (const BenchLeftOut& out : work.run.left_out)
        work.console.line(fmt::format("  left out: {} {}: {}", out.scene, out.technique, out.why));
    return complete;
}

} // namespace shadowproof
