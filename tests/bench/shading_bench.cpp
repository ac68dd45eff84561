// What truth of colour costs against truth of visibility: the counter `ratio` is the median of the
// pairwise ratios, visibility and lighting over visibility alone, each pair taken one right after
// the other. Fails above 2.
//   build/bench/tests/bench/shadowproof_shading_bench

#include "reference/shade/shading.h"
#include "scenes/generated.h"
#include "scenes/load/catalog.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

namespace shadowproof {
namespace {

using Clock = std::chrono::steady_clock;

double seconds(const Clock::duration& d) {
    return std::chrono::duration<double>(d).count();
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

constexpr double most = 2;

void measure(benchmark::State& state, const Scene& scene) {
    const Tracer tracer(scene);
    std::vector<double> ratios;
    std::vector<double> times;
    for (auto _ : state) {
        const auto start = Clock::now();
        const GroundTruth truth = trace(tracer);
        const auto middle = Clock::now();
        benchmark::DoNotOptimize(shade(tracer, truth));
        const auto end = Clock::now();
        ratios.push_back(seconds(end - start) / seconds(middle - start));
        times.push_back(seconds(end - middle));
        state.SetIterationTime(seconds(end - start));
    }
    const double pixels = scene.camera.width * scene.camera.height;
    state.counters["ratio"] = median(ratios);
    state.counters["shading_us_per_pixel_thread"] = median(times) * 1e6 * tracer.threads() / pixels;
    if (median(ratios) > most)
        state.SkipWithError(fmt::format("the ratio is {:.2f}", median(ratios)).c_str());
}

/// dense_scene with a normal map and a decal, both with texels of many values, on every triangle.
Scene dense_bumpy_scene(int triangles, int size) {
    Scene scene = dense_scene(triangles, size, size);
    TextureImage map;
    map.texels = Image<glm::vec4>(256, 256);
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 256; ++x)
            map.texels.at(x, y) = {0.5 + 0.3 * std::sin(x * 0.7), 0.5 + 0.3 * std::sin(y * 0.5),
                                   0.9, 0.5};
    scene.textures = {map};
    for (Material& material : scene.materials) {
        material.bump = Bump::normal_map;
        material.bump_map = material.decal = 0;
        material.gloss_in_alpha = true;
    }
    for (const glm::uvec3& triangle : scene.triangles)
        for (int k = 0; k < 3; ++k) {
            const glm::vec3 place = scene.positions[triangle[k]];
            const glm::vec2 at(place.x / 4, place.z / 4); // a texel is about a pixel
            scene.surfaces.push_back({{0, 1, 0}, {1, 0, 0, 1}, at, at});
        }
    return scene;
}

void dense(benchmark::State& state) {
    measure(state, dense_bumpy_scene(static_cast<int>(state.range(0)), 512));
}

void bundled(benchmark::State& state, const std::string& name) {
    measure(state, load_scene(name, {}));
}

BENCHMARK(dense)
    ->ArgName("triangles")
    ->Arg(10'000)
    ->Arg(100'000)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(15)
    ->UseManualTime();

const bool registered = [] {
    for (const BundledScene& scene : bundled_scenes())
        if (is_bump_lit(load_scene(std::string(scene.name), {})))
            benchmark::RegisterBenchmark(std::string(scene.name).c_str(), bundled,
                                         std::string(scene.name))
                ->Unit(benchmark::kMillisecond)
                ->Iterations(15)
                ->UseManualTime();
    return true;
}();

} // namespace
} // namespace shadowproof
