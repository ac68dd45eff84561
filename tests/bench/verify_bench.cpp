// Where the time of a verified cell goes: truth, shadow depths, rendering and classification of
// each technique on each bundled scene. The whole command is timed from outside:
//   build/bench/tests/bench/shadowproof_verify_bench
//   time build/release/shadowproof verify ordinary

#include "compare/classify.h"
#include "compare/families.h"
#include "raster/render.h"
#include "raster/technique.h"
#include "scenes/load/catalog.h"
#include "scenes/plan/plan.h"

#include <benchmark/benchmark.h>

#include <string>

namespace shadowproof {
namespace {

void truth(benchmark::State& state, const std::string& name) {
    const Scene scene = load_scene(name, {});
    for (auto _ : state) {
        const Tracer tracer(scene);
        benchmark::DoNotOptimize(trace(tracer));
    }
}

void shadow_depths(benchmark::State& state, const std::string& name) {
    const Scene scene = load_scene(name, {});
    const Tracer tracer(scene);
    const GroundTruth ground = trace(tracer);
    for (auto _ : state)
        benchmark::DoNotOptimize(count_shadow_depths(tracer, ground, finite_far(scene)));
}

void rendering(benchmark::State& state, const std::string& name, const Technique& technique) {
    const Scene scene = load_scene(name, {});
    const Plan plan = make_plan(scene);
    Gpu gpu(GlPlatform::osmesa);
    for (auto _ : state) benchmark::DoNotOptimize(render(technique, scene, plan, gpu));
}

void classification(benchmark::State& state, const std::string& name, const Technique& technique) {
    const Scene scene = load_scene(name, {});
    const Tracer tracer(scene);
    const GroundTruth ground = trace(tracer);
    const TracedScene traced(tracer, ground);
    traced.depths();
    Gpu gpu(GlPlatform::osmesa);
    const Frame frame = render(technique, scene, make_plan(scene), gpu);
    for (auto _ : state)
        benchmark::DoNotOptimize(classify(traced, frame, *judge_of(traced, frame)));
}

const bool registered = [] {
    const auto add = [](const std::string& title, auto function, auto... arguments) {
        benchmark::RegisterBenchmark(title.c_str(), function, arguments...)
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
    };
    for (const BundledScene& scene : bundled_scenes()) {
        const std::string name(scene.name);
        const Scene loaded = load_scene(name, {});
        add("truth/" + name, truth, name);
        add("shadow_depths/" + name, shadow_depths, name);
        for (const Technique& technique : all_techniques()) {
            if (!suits(technique, loaded)) continue;
            add("render/" + name + "/" + std::string(technique.name), rendering, name, technique);
            add("classify/" + name + "/" + std::string(technique.name), classification, name,
                technique);
        }
    }
    return true;
}();

} // namespace
} // namespace shadowproof
