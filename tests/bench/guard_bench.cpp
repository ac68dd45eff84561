// What it costs that a crash loses one cell and no more: the cells of a scene judged under a
// supervisor, piece by piece as `verify` does, beside the same cells in a process without one. Both
// are this program again, started in turn, and timed from outside, their start included.
//   build/bench/tests/bench/shadowproof_guard_bench [ROUNDS] [SCENE...]

#include "compare/command/judged_cell.h"
#include "compare/command/pieces/report_archive.h"
#include "compare/command/pieces/supervisor.h"
#include "compare/command/process/run_program.h"
#include "raster/technique.h"
#include "scenes/load/catalog.h"
#include "scenes/plan/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

namespace shadowproof {
namespace {

/// Judges all techniques that suit a scene. `piece` does a cell, given its name and the work.
template <class Piece>
std::vector<Cell> cells_of(const std::string& name, const Piece& piece) {
    const Scene scene = load_scene(name, {});
    const Tracer tracer(scene);
    const GroundTruth truth = trace(tracer);
    const TracedScene traced(tracer, truth);
    const Plan plan = make_plan(scene);
    Gpu gpu(GlPlatform::osmesa);
    std::vector<Cell> cells;
    for (const Technique& technique : all_techniques())
        if (suits(technique, scene))
            cells.push_back(piece(std::string(technique.name), [&] {
                return judged_cell(technique, traced, plan, gpu, {.evidence = true}).cell;
            }));
    return cells;
}

int work_plainly(const std::string& scene) {
    const std::vector<Cell> cells =
        cells_of(scene, [](const std::string&, const auto& work) { return work(); });
    return cells.empty() ? 1 : 0;
}

int work_supervised(const std::string& scene) {
    Console console(true);
    const std::vector<Cell> cells = supervised({.console = console}, [&](Pieces& pieces) {
        return cells_of(scene, [&](const std::string& name, const auto& work) {
            return pieces.piece(name, work);
        });
    });
    return cells.empty() ? 1 : 0;
}

/// Milliseconds of this program, started again.
double milliseconds_of(const std::string& program, const std::string& how,
                       const std::string& scene) {
    const auto start = std::chrono::steady_clock::now();
    const ProgramEnd end = run_program({program, how, scene}, "/dev/null", 0);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    if (end.code != 0) {
        fmt::print(stderr, "{} {}: {}\n", scene, how, words_of(end));
        std::exit(1);
    }
    return took.count();
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

void compare(const std::string& program, const std::string& scene, int rounds) {
    std::vector<double> plain;
    std::vector<double> ratios;
    for (int round = 0; round < rounds; ++round) {
        plain.push_back(milliseconds_of(program, "--plain", scene));
        ratios.push_back(milliseconds_of(program, "--supervised", scene) / plain.back());
    }
    fmt::print("{:24} {:8.0f} ms without, {:+6.2f} % with a supervisor\n", scene, median(plain),
               100 * (median(ratios) - 1));
}

} // namespace
} // namespace shadowproof

int main(int count, char** arguments) {
    using namespace shadowproof;
    const std::vector<std::string> words(arguments, arguments + count);
    if (words.size() == 3 && words[1] == "--plain") return work_plainly(words[2]);
    if (words.size() == 3 && words[1] == "--supervised") return work_supervised(words[2]);
    const int rounds = words.size() > 1 ? std::atoi(words[1].c_str()) : 11;
    std::vector<std::string> scenes(words.begin() + std::min<std::ptrdiff_t>(2, count),
                                    words.end());
    if (scenes.empty()) scenes = {"ordinary", "nested", "bumpy_sphere"};
    for (const std::string& scene : scenes) compare(words[0], scene, rounds);
}
