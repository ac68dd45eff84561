// Exact truth against plain float tracing of the same rays: the counter `ratio` is the median of
// the pairwise ratios, exact over float, each pair taken one right after the other. And exact truth
// seen in parallel against the same scene in perspective.
//   build/bench/tests/bench/shadowproof_trace_bench

#include "reference/trace/trace.h"
#include "scenes/generated.h"
#include "tests/bench/float_tracer.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

namespace shadowproof {
namespace {

double seconds(const std::chrono::steady_clock::duration& d) {
    return std::chrono::duration<double>(d).count();
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

void exact_over_float(benchmark::State& state) {
    const auto triangles = static_cast<int>(state.range(0));
    const Scene scene =
        dense_scene(triangles, static_cast<int>(state.range(1)), static_cast<int>(state.range(2)));
    const Tracer exact(scene);
    const FloatTracer plain(scene, 0);
    std::vector<double> ratios;
    std::vector<double> times;
    std::uint64_t wrong = 0;
    std::uint64_t exact_decisions = 0;
    for (auto _ : state) {
        const auto start = std::chrono::steady_clock::now();
        const GroundTruth truth = trace(exact);
        const auto middle = std::chrono::steady_clock::now();
        const Image<Visibility> floats = plain.trace();
        const auto end = std::chrono::steady_clock::now();
        ratios.push_back(seconds(middle - start) / seconds(end - middle));
        times.push_back(seconds(middle - start));
        state.SetIterationTime(seconds(middle - start));
        wrong = 0;
        for (std::size_t i = 0; i < floats.pixels.size(); ++i)
            wrong += floats.pixels[i] != truth.visibility.pixels[i] ? 1 : 0;
        exact_decisions = truth.statistics.exact_decisions;
    }
    const double pixels = static_cast<double>(state.range(1) * state.range(2));
    state.counters["ratio"] = median(ratios);
    state.counters["us_per_pixel_thread"] = median(times) * 1e6 * exact.threads() / pixels;
    state.counters["float_wrong_pixels"] = static_cast<double>(wrong);
    state.counters["exact_decisions"] = static_cast<double>(exact_decisions);
}

BENCHMARK(exact_over_float)
    ->ArgNames({"triangles", "width", "height"})
    ->ArgsProduct({{10'000, 100'000, 1'000'000}, {512}, {512}})
    ->ArgsProduct({{10'000, 100'000, 1'000'000}, {1920}, {1080}})
    ->ArgsProduct({{1'000'000, 10'000'000}, {3840}, {2160}})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(9)
    ->UseManualTime();

/// Looks down on the balls by 45 degrees, so that every pixel shows a surface.
Scene from_above(int triangles) {
    Scene scene = dense_scene(triangles, 512, 512);
    const double slope = std::sqrt(0.5);
    scene.camera.eye = {0.137, 4.7, -1.5};
    scene.camera.up = {0, slope, -slope};
    scene.camera.forward = {0, -slope, -slope};
    scene.camera.half_height = 0.34;
    return scene;
}

/// The picture shows what the perspective one shows at the balls' depth.
Scene seen_in_parallel(Scene scene) {
    constexpr double depth_of_balls = 7;
    scene.camera.projection = Projection::orthographic;
    scene.camera.half_height *= depth_of_balls;
    return scene;
}

double seen_pixels(const GroundTruth& truth) {
    const std::vector<Visibility>& pixels = truth.visibility.pixels;
    return static_cast<double>(pixels.size()) -
           static_cast<double>(std::count(pixels.begin(), pixels.end(), Visibility::background));
}

/// `ratio`: of the times; `seen`: of how many pixels show a surface.
void orthographic_over_perspective(benchmark::State& state) {
    const Scene scene = from_above(static_cast<int>(state.range(0)));
    const Scene parallel_scene = seen_in_parallel(scene);
    const Tracer perspective(scene);
    const Tracer orthographic(parallel_scene);
    const double seen = seen_pixels(trace(orthographic)) / seen_pixels(trace(perspective));
    std::vector<double> ratios;
    for (auto _ : state) {
        const auto start = std::chrono::steady_clock::now();
        benchmark::DoNotOptimize(trace(orthographic));
        const auto middle = std::chrono::steady_clock::now();
        benchmark::DoNotOptimize(trace(perspective));
        const auto end = std::chrono::steady_clock::now();
        ratios.push_back(seconds(middle - start) / seconds(end - middle));
        state.SetIterationTime(seconds(middle - start));
    }
    state.counters["ratio"] = median(ratios);
    state.counters["seen"] = seen;
}

BENCHMARK(orthographic_over_perspective)
    ->ArgName("triangles")
    ->Args({10'000})
    ->Args({100'000})
    ->Args({1'000'000})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(9)
    ->UseManualTime();

} // namespace
} // namespace shadowproof
