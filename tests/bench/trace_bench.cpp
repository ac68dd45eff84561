// Exact truth against plain float tracing of the same rays: the counter `ratio` is the median of
// the pairwise ratios, exact over float, each pair taken one right after the other.
//   build/bench/tests/bench/shadowproof_trace_bench

#include "reference/trace/trace.h"
#include "scenes/generated.h"
#include "tests/bench/float_tracer.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
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

} // namespace
} // namespace shadowproof
