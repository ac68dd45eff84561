// What each technique costs beside the others, on each bundled scene and in one run: all are drawn
// in turn, round after round, and the quickest frame of each counts. Rightness is asked first: a
// technique is right on a scene where nothing differs but `edge`. Exits with 1 where `auto` is not
// right although `zfail_reversed` is, where it takes more than 1.1 times as long as the quickest
// right technique, and, over all bundled scenes, where it is nowhere 1.5 times as quick as
// `zfail_reversed`.
//   build/bench/tests/bench/shadowproof_technique_bench [ROUNDS] [SCENE...]

#include "compare/classify.h"
#include "compare/families.h"
#include "raster/render.h"
#include "raster/technique.h"
#include "scenes/load/catalog.h"
#include "scenes/plan/caster_plan.h"
#include "scenes/plan/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace shadowproof {
namespace {

struct Cost {
    bool right = false;
    double milliseconds = std::numeric_limits<double>::infinity();
    std::optional<std::uint64_t> fragments; ///< of volumes, where any are counted
};

using Costs = std::map<std::string_view, Cost>; // by technique

bool is_right(const TracedScene& traced, const Frame& frame) {
    const Comparison comparison = classify(traced, frame, *judge_of(traced, frame));
    return comparison.differing == comparison.causes[static_cast<std::size_t>(Cause::edge)];
}

/// Of those that count volumes, among which `auto` chooses. Null where none but `auto` is right.
const Costs::value_type* quickest_right(const Costs& costs) {
    const Costs::value_type* best = nullptr;
    for (const auto& entry : costs) {
        const auto& [technique, cost] = entry;
        if (cost.right && cost.fragments && technique != "auto" &&
            (best == nullptr || cost.milliseconds < best->second.milliseconds))
            best = &entry;
    }
    return best;
}

/// Whether `auto` took too long beside the quickest right technique, if any.
bool is_slow(const Costs& costs, const Costs::value_type* best) {
    return best != nullptr && costs.at("auto").milliseconds > 1.1 * best->second.milliseconds;
}

/// The quickest of many is quick by chance, too: where `auto` seems slow, all are drawn in up to
/// four times as many rounds.
Costs measure(Gpu& gpu, const Scene& scene, int rounds) {
    const Plan plan = make_plan(scene);
    const Tracer tracer(scene);
    const GroundTruth truth = trace(tracer);
    const TracedScene traced(tracer, truth);
    Costs costs;
    double quickest = std::numeric_limits<double>::infinity();
    const auto asks_for_more = [&](int round) {
        return round < rounds || (round < 4 * rounds && is_slow(costs, quickest_right(costs)));
    };
    for (int round = 0; asks_for_more(round); ++round)
        for (const Technique& technique : all_techniques()) {
            if (!suits(technique, scene)) continue;
            Cost& cost = costs[technique.name];
            // What is far behind need not be known so well.
            if (round > 0 && cost.milliseconds > 4 * quickest) continue;
            const Frame frame = render(technique, scene, plan, gpu);
            cost.milliseconds = std::min(cost.milliseconds, frame.milliseconds);
            if (frame.counted) cost.fragments = frame.counted->volume_fragments;
            quickest = std::min(quickest, cost.milliseconds);
            if (round == 0) cost.right = is_right(traced, frame);
        }
    return costs;
}

/// What auto thinks of before it draws, which is not in its time.
double planning_milliseconds(const Scene& scene) {
    std::chrono::steady_clock::duration quickest = std::chrono::steady_clock::duration::max();
    for (int i = 0; i < 3; ++i) {
        const auto start = std::chrono::steady_clock::now();
        plan_casters(scene);
        quickest = std::min(quickest, std::chrono::steady_clock::now() - start);
    }
    return std::chrono::duration<double, std::milli>(quickest).count();
}

struct Sums {
    double log_of_cost = 0; ///< against zfail_reversed
    double log_of_fragments = 0;
    bool counts = false; ///< volumes
    int scenes = 0;
    int right = 0;
};

void add(std::map<std::string_view, Sums>& sums, const Costs& costs) {
    const Cost& whole = costs.at("zfail_reversed");
    for (const auto& [technique, cost] : costs) {
        Sums& sum = sums[technique];
        sum.log_of_cost += std::log(cost.milliseconds / whole.milliseconds);
        sum.counts = cost.fragments.has_value();
        sum.log_of_fragments += std::log(static_cast<double>(cost.fragments.value_or(0) + 1) /
                                         static_cast<double>(*whole.fragments + 1));
        ++sum.scenes;
        sum.right += cost.right ? 1 : 0;
    }
}

/// How `auto` fared on all scenes.
struct Record {
    int wrong = 0;          ///< scenes, where zfail_reversed is right
    int slow = 0;           ///< scenes
    double most_gained = 0; ///< times as quick as zfail_reversed, at best
};

void add(Record& record, const Costs& costs, const Costs::value_type* best) {
    const Cost& whole = costs.at("zfail_reversed");
    const Cost& chosen = costs.at("auto");
    record.wrong += whole.right && !chosen.right ? 1 : 0;
    record.slow += is_slow(costs, best) ? 1 : 0;
    record.most_gained = std::max(record.most_gained, whole.milliseconds / chosen.milliseconds);
}

void print_scene(const std::string& name, const Costs& costs, const Costs::value_type* best,
                 double planning) {
    const Cost& whole = costs.at("zfail_reversed");
    const Cost& chosen = costs.at("auto");
    fmt::print("{:<20}{:>10.2f}", name, chosen.milliseconds);
    if (best != nullptr)
        fmt::print("{:>10.2f}{:>8.2f}  {:<22}", best->second.milliseconds,
                   chosen.milliseconds / best->second.milliseconds, best->first);
    else
        fmt::print("{:>10}{:>8}  {:<22}", "", "", "none");
    fmt::print("{:>10.2f}{:>10.2f}{:>10.2f}{}\n", whole.milliseconds,
               whole.milliseconds / chosen.milliseconds, planning,
               whole.right && !chosen.right ? "  auto is wrong" : "");
}

/// `stated` is what the technique says of itself.
void print_means(std::map<std::string_view, Sums>& sums) {
    fmt::print("\n{:<24}{:>8}{:>8}{:>12}{:>8}\n", "against zfail_reversed", "time", "stated",
               "fragments", "right");
    for (const Technique& technique : all_techniques()) {
        const Sums& sum = sums[technique.name];
        const std::string fragments =
            sum.counts ? fmt::format("{:.2f}", std::exp(sum.log_of_fragments / sum.scenes)) : "-";
        fmt::print("{:<24}{:>8.2f}{:>8.2f}{:>12}{:>5}/{}\n", technique.name,
                   std::exp(sum.log_of_cost / sum.scenes), technique.cost, fragments, sum.right,
                   sum.scenes);
    }
}

bool holds(const Record& record, bool all_scenes) {
    if (record.wrong > 0)
        fmt::print("auto is wrong on {} where zfail_reversed is right\n", record.wrong);
    if (record.slow > 0)
        fmt::print("auto takes more than 1.1 times as long as the quickest right one on {}\n",
                   record.slow);
    const bool gains = !all_scenes || record.most_gained >= 1.5;
    if (!gains)
        fmt::print("auto is {:.2f} times as quick as zfail_reversed at best, and should be 1.5\n",
                   record.most_gained);
    return record.wrong == 0 && record.slow == 0 && gains;
}

int run(int rounds, std::vector<std::string> names) {
    Gpu gpu(GlPlatform::osmesa);
    gpu.time_frames(3);
    const bool all_scenes = names.empty();
    if (all_scenes)
        for (const BundledScene& scene : bundled_scenes()) names.emplace_back(scene.name);
    std::map<std::string_view, Sums> sums;
    Record record;
    fmt::print("{:<20}{:>10}{:>10}{:>8}  {:<22}{:>10}{:>10}{:>10}\n", "scene", "auto ms",
               "right ms", "ratio", "quickest right", "reversed", "x faster", "plan ms");
    for (const std::string& name : names) {
        SceneRequest request;
        request.every_light = true;
        Scene scene = load_scene(name, request);
        for (scene.light = 0; scene.light < scene.lights.size(); ++scene.light) {
            const Costs costs = measure(gpu, scene, rounds);
            const Costs::value_type* best = quickest_right(costs);
            add(sums, costs);
            add(record, costs, best);
            print_scene(name, costs, best, planning_milliseconds(scene));
        }
    }
    print_means(sums);
    return holds(record, all_scenes) ? EXIT_SUCCESS : EXIT_FAILURE;
}

} // namespace
} // namespace shadowproof

int main(int argc, char** argv) {
    const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
    return shadowproof::run(rounds, {argv + std::min(argc, 2), argv + argc});
}
