#include "compare/command/bench/scaling.h"

#include "compare/bench/bench_table.h"
#include "compare/command/bench/sweep.h"
#include "compare/command/standard_output.h"
#include "compare/command/stopwatch.h"
#include "compare/memory.h"
#include "compare/report/escape.h"
#include "compare/words.h"
#include "raster/render.h"
#include "reference/trace/trace.h"
#include "scenes/error.h"
#include "scenes/generated.h"
#include "scenes/load/catalog.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

namespace shadowproof {

namespace {

/// What grows. A line of the table below for each.
struct Axis {
    const char* name;
    std::vector<int> sizes; ///< as `scene` takes them
    std::size_t quick;      ///< so many of the sizes with --quick
    double (*value)(int size);
    Scene (*scene)(const BenchOptions& options, int size);
};

double as_it_is(int size) {
    return size;
}

std::string scene_of_pixels(const BenchOptions& options) {
    return options.scenes.empty() ? "ordinary" : options.scenes.front();
}

std::vector<Axis> axes() {
    return {{"pixels",
             {64, 128, 256, 512, 1024, 2048, 4096},
             4,
             [](int side) { return static_cast<double>(side) * side; },
             [](const BenchOptions& options, int side) {
                 SceneRequest request = options.scene.request();
                 request.width = side;
                 request.height = side;
                 return load_scene(scene_of_pixels(options), request);
             }},
            {"triangles",
             {1'000, 4'000, 16'000, 64'000, 256'000, 1'000'000, 4'000'000},
             4,
             as_it_is,
             [](const BenchOptions& options, int triangles) {
                 const auto [width, height] = options.scene.size;
                 return dense_scene(triangles, width, height);
             }},
            {"volumes",
             {1, 2, 4, 8, 16, 32, 64},
             5,
             as_it_is,
             [](const BenchOptions& options, int plates) {
                 const auto [width, height] = options.scene.size;
                 return stacked_scene(plates, width, height);
             }}};
}

/// What is measured along an axis, and whether it still is.
struct Runner {
    const Technique* technique; ///< null: the truth
    Growth growth;
    bool stopped = false;
};

std::vector<Runner> runners_along(const BenchWork& work, const Axis& axis, const Scene& scene) {
    const auto growth = [&](const std::string& technique) {
        std::string command = "shadowproof bench --scaling";
        if (axis.name == std::string_view("pixels"))
            command += " " + shell_quoted(scene_of_pixels(work.options));
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
    std::vector<Runner> runners{{nullptr, growth(truth_point)}};
    for (const Technique* technique : work.options.technique.chosen())
        if (suits(*technique, scene))
            runners.push_back({technique, growth(std::string(technique->name))});
    return runners;
}

void stop(const BenchWork& work, Runner& runner, const std::string& why) {
    runner.stopped = true;
    work.run.left_out.push_back({runner.growth.scene, runner.growth.technique, {}, why});
}

/// One size: each runner draws once to warm up, and all are measured in rounds.
void measure_size(const BenchWork& work, std::vector<Runner>& runners, const Scene& scene,
                  const std::string& where, double value) {
    require_scene(work.options.scene.memory, scene, Workload::comparison);
    const Tracer tracer(scene, work.options.scene.threads);
    Plan plan = make_plan(scene);
    plan.asked = work.options.technique.asked;
    const auto draw = [&](const Runner& runner) {
        return runner.technique == nullptr
                   ? trace(tracer).statistics.milliseconds
                   : render(*runner.technique, scene, plan, work.gpu).milliseconds;
    };
    const double most_seconds = work.options.quick ? 0.7 : 4; // of work for a sample
    std::vector<Runner*> drawn;
    for (Runner& runner : runners) {
        if (runner.stopped) continue;
        work.console.progress(fmt::format("{}: {}", where, runner.growth.technique));
        try {
            const Stopwatch stopwatch;
            draw(runner);
            drawn.push_back(&runner);
            const double seconds = stopwatch.milliseconds() / 1000;
            if (seconds > most_seconds)
                stop(work, runner,
                     fmt::format("not measured beyond {}: a sample took {:.1f} s", where, seconds));
        } catch (const Error& error) {
            stop(work, runner, error.what());
        }
    }
    std::vector<std::vector<double>> samples(drawn.size());
    const Stopwatch stopwatch;
    measure_in_rounds(
        samples,
        {.repeats = work.options.quick ? 7U : 15U, .seconds = work.options.quick ? 4.0 : 30.0},
        {.measure = [&](std::size_t i) { return draw(*drawn[i]); },
         .seconds = [&] { return stopwatch.milliseconds() / 1000; },
         .before =
             [&](std::size_t i) {
                 work.console.progress(fmt::format("{}: {}, sample {}", where,
                                                   drawn[i]->growth.technique,
                                                   samples[i].size() + 1));
             },
         .after_round = [] {}});
    for (std::size_t i = 0; i < drawn.size(); ++i)
        drawn[i]->growth.points.push_back({value, samples[i]});
}

/// Whether an earlier run had the axis: its growth is taken over.
bool take_over(const BenchWork& work, const Axis& axis) {
    if (work.kept == nullptr) return false;
    bool found = false;
    for (const Growth& growth : work.kept->growth)
        if (growth.axis == axis.name) {
            work.run.growth.push_back(growth);
            found = true;
        }
    return found;
}

void measure_axis(const BenchWork& work, const Axis& axis) {
    std::vector<Runner> runners;
    const std::size_t sizes = work.options.quick ? axis.quick : axis.sizes.size();
    for (std::size_t i = 0; i < sizes; ++i) {
        const double value = axis.value(axis.sizes[i]);
        const std::string where = fmt::format(
            "{} {}, {} of {}", grouped(static_cast<std::uint64_t>(value)), axis.name, i + 1, sizes);
        try {
            const Scene scene = axis.scene(work.options, axis.sizes[i]);
            if (runners.empty()) runners = runners_along(work, axis, scene);
            measure_size(work, runners, scene, where, value);
        } catch (const std::bad_alloc&) {
            work.run.left_out.push_back({axis.name, {}, {}, where + ": " + out_of_memory});
            break;
        } catch (const Error& error) {
            if (i == 0) throw;
            work.run.left_out.push_back({axis.name, {}, {}, error.what()});
            break;
        }
    }
    for (Runner& runner : runners)
        if (!runner.growth.points.empty()) work.run.growth.push_back(std::move(runner.growth));
}

} // namespace

bool measure_growth(const BenchWork& work) {
    bool complete = true;
    for (const Axis& axis : axes()) {
        if (take_over(work, axis)) continue;
        try {
            measure_axis(work, axis);
        } catch (const Error& error) {
            complain(error.what());
            work.run.left_out.push_back({axis.name, {}, {}, error.what()});
            complete = false;
        }
        work.keeper.keep(work.run);
    }
    work.console.clear_progress();
    for (const std::string& line : growth_table(work.run)) work.console.line(line);
    for (const BenchLeftOut& out : work.run.left_out)
        work.console.line(fmt::format("  left out: {} {}: {}", out.scene, out.technique, out.why));
    return complete;
}

} // namespace shadowproof
