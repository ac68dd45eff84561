// What each technique costs beside the others, on each bundled scene and in one run: all are drawn
// in turn, round after round, and the quickest frame of each counts. Rightness is asked first: a
// technique is right on a scene where nothing differs but `edge`. Exits with 1 where `auto` is
// slower than 1.1 times the quickest right technique.
//   build/bench/tests/bench/shadowproof_technique_bench [ROUNDS] [SCENE...]

#include "compare/classify.h"
#include "raster/render.h"
#include "raster/technique.h"
#include "scenes/caster_plan.h"
#include "scenes/catalog.h"
#include "scenes/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace shadowproof {
namespace {

struct Cost {
    bool right = false;
    double milliseconds = std::numeric_limits<double>::infinity();
    std::uint64_t fragments = 0;
};

using Costs = std::map<std::string_view, Cost>; // by technique

bool is_right(const Tracer& tracer, const Silhouette& silhouette, const GroundTruth& truth,
              const ShadowDepths& depths, const Frame& frame) {
    const Prediction prediction(tracer, silhouette, truth, depths, frame.counting,
                                frame.depth_model);
    const Comparison comparison = classify(tracer, silhouette, truth, depths, frame, prediction);
    return comparison.differing == comparison.causes[static_cast<std::size_t>(Cause::edge)];
}

Costs measure(Gpu& gpu, const Scene& scene, int rounds) {
    const Plan plan = make_plan(scene);
    const Tracer tracer(scene);
    const GroundTruth truth = trace(tracer);
    const ShadowDepths depths = count_shadow_depths(tracer, truth, finite_far(scene));
    const Silhouette silhouette(tracer);
    Costs costs;
    double quickest = std::numeric_limits<double>::infinity();
    for (int round = 0; round < rounds; ++round)
        for (const Technique& technique : all_techniques()) {
            Cost& cost = costs[technique.name];
            // What is far behind need not be known so well.
            if (round > 0 && cost.milliseconds > 4 * quickest) continue;
            const Frame frame = render(technique, scene, plan, gpu);
            cost.milliseconds = std::min(cost.milliseconds, frame.milliseconds);
            cost.fragments = frame.volume_fragments;
            quickest = std::min(quickest, cost.milliseconds);
            if (round == 0) cost.right = is_right(tracer, silhouette, truth, depths, frame);
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
    int scenes = 0;
    int right = 0;
};

int run(int rounds, const std::vector<std::string>& names) {
    Gpu gpu(GlPlatform::osmesa);
    std::map<std::string_view, Sums> sums;
    bool holds = true;
    fmt::print("{:<20}{:>10}{:>10}{:>8}  {:<22}{:>10}{:>10}{:>10}\n", "scene", "auto ms",
               "right ms", "ratio", "quickest right", "reversed", "x faster", "plan ms");
    for (const std::string& name : names) {
        SceneRequest request;
        request.every_light = true;
        Scene scene = load_scene(name, request);
        for (scene.light = 0; scene.light < scene.lights.size(); ++scene.light) {
            const Costs costs = measure(gpu, scene, rounds);
            const Cost& whole = costs.at("zfail_reversed");
            const Cost& chosen = costs.at("auto");
            const std::pair<const std::string_view, Cost>* best = nullptr;
            for (const auto& entry : costs) {
                const auto& [technique, cost] = entry;
                Sums& sum = sums[technique];
                sum.log_of_cost += std::log(cost.milliseconds / whole.milliseconds);
                sum.log_of_fragments += std::log(static_cast<double>(cost.fragments + 1) /
                                                 static_cast<double>(whole.fragments + 1));
                ++sum.scenes;
                sum.right += cost.right ? 1 : 0;
                if (cost.right && technique != "auto" &&
                    (best == nullptr || cost.milliseconds < best->second.milliseconds))
                    best = &entry;
            }
            fmt::print("{:<20}{:>10.2f}", name, chosen.milliseconds);
            if (best != nullptr) {
                const double ratio = chosen.milliseconds / best->second.milliseconds;
                holds = holds && ratio <= 1.1;
                fmt::print("{:>10.2f}{:>8.2f}  {:<22}", best->second.milliseconds, ratio,
                           best->first);
            } else {
                fmt::print("{:>10}{:>8}  {:<22}", "", "", "none");
            }
            fmt::print("{:>10.2f}{:>10.2f}{:>10.2f}\n", whole.milliseconds,
                       whole.milliseconds / chosen.milliseconds, planning_milliseconds(scene));
        }
    }
    fmt::print("\n{:<24}{:>8}{:>12}{:>8}\n", "against zfail_reversed", "time", "fragments",
               "right");
    for (const Technique& technique : all_techniques()) {
        const Sums& sum = sums[technique.name];
        fmt::print("{:<24}{:>8.2f}{:>12.2f}{:>5}/{}\n", technique.name,
                   std::exp(sum.log_of_cost / sum.scenes),
                   std::exp(sum.log_of_fragments / sum.scenes), sum.right, sum.scenes);
    }
    return holds ? EXIT_SUCCESS : EXIT_FAILURE;
}

} // namespace
} // namespace shadowproof

int main(int argc, char** argv) {
    const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
    std::vector<std::string> names(argv + std::min(argc, 2), argv + argc);
    if (names.empty())
        for (const auto& scene : shadowproof::bundled_scenes()) names.emplace_back(scene.name);
    return shadowproof::run(rounds, names);
}
