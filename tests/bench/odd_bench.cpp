// What degenerate scenes cost beside ordinary ones: rays through vertices, lights in planes and on
// edges, triangles that coincide. For each scene the quickest of some rounds counts, of the truth
// (tracing) and of the judgement of one technique apart, and both are divided by those of the
// ordinary scene that it was made from, measured in the same rounds.
//   build/bench/tests/bench/shadowproof_odd_bench [ROUNDS] [NAME...]

#include "compare/classify.h"
#include "compare/families.h"
#include "raster/render.h"
#include "raster/technique.h"
#include "scenes/generated.h"
#include "scenes/load/catalog.h"
#include "scenes/plan/plan.h"
#include "scenes/stress/parameter.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace shadowproof {
namespace {

constexpr int side = 160; ///< pixels: the size at which `stress` looks at scenes

struct Odd {
    std::string name;
    std::function<Scene()> make;
};

/// Degenerate scenes after the ordinary one that they are compared with.
using Row = std::vector<Odd>;

Scene small(const char* name) {
    Scene scene = load_scene(name, {});
    scene.camera.width = scene.camera.height = side;
    return scene;
}

/// A grid of quads that faces the camera, a plate before it; its vertices lie `off` pixels beside
/// the rays of the pixels, all of which meet one where it is 0.
Scene grid(double off) {
    constexpr int width = 128; // a power of two: rays have few bits
    constexpr float depth = 4;
    Scene scene;
    scene.name = "grid";
    scene.camera.width = scene.camera.height = width;
    const auto at = [&](int x, int y) {
        const auto place = [&](int i) {
            return static_cast<float>((2 * (i + off) + 1) / width - 1) * depth;
        };
        return glm::vec3(place(x), place(y), -depth);
    };
    const auto add = [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
        const auto first = static_cast<glm::uint>(scene.positions.size());
        scene.positions.insert(scene.positions.end(), {a, b, c});
        scene.triangles.emplace_back(first, first + 1, first + 2);
    };
    for (int y = 0; y + 1 < width; ++y)
        for (int x = 0; x + 1 < width; ++x) {
            add(at(x, y), at(x + 1, y), at(x + 1, y + 1));
            add(at(x, y), at(x + 1, y + 1), at(x, y + 1));
        }
    add({-0.5F, -0.5F, -2}, {0.5F, -0.5F, -2}, {0.5F, 0.5F, -2});
    scene.materials = {{"material", true}};
    scene.meshes = {{"grid", 0, static_cast<std::uint32_t>(scene.triangles.size()), 0}};
    scene.lights.emplace_back();
    scene.lights[0].position = {0.25, 0.25, -1};
    return scene;
}

std::vector<Row> rows() {
    Row stresses{{"ordinary", [] { return small("ordinary"); }}};
    for (const auto& [parameter, value] : std::vector<std::pair<const char*, double>>{
             {"coincident_faces", 5},
             {"coincident_faces", 64},
             {"light_elevation", 1e-6},
             {"light_elevation", 0},
             {"light_to_face", 0},
             {"light_to_edge", 0},
             {"light_to_vertex", 1e-16},
             {"light_to_face", 1e7},
             {"light_w", 0},
             {"origin_distance", 1e6},
             {"sliver_aspect", 1e9},
         }) {
        const Stress stress{parameter, value};
        stresses.push_back(
            {words_of(stress), [stress] { return stressed(small("ordinary"), stress); }});
    }
    const auto nested = [] {
        return stressed(small("ordinary"), {.parameter = "nested_volumes", .value = 100});
    };
    return {stresses,
            {{"as many triangles", [] { return dense_scene(570'000, side, side); }},
             {"nested_volumes=100", nested}},
            {{"grid beside rays", [] { return grid(0.37); }},
             {"grid on rays", [] { return grid(0); }}}};
}

double milliseconds_of(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
        .count();
}

/// A scene, drawn once, and the quickest of its rounds.
struct Measured {
    Scene scene;
    Tracer tracer;
    Frame frame;
    std::uint64_t exact_decisions = 0;
    double truth = std::numeric_limits<double>::infinity();   ///< milliseconds
    double judging = std::numeric_limits<double>::infinity(); ///< milliseconds

    Measured(Scene made, Gpu& gpu)
        : scene(std::move(made)), tracer(scene),
          frame(render(*find_technique("zfail_reversed"), scene, make_plan(scene), gpu)) {}
    Measured(const Measured&) = delete;
    Measured& operator=(const Measured&) = delete;

    void measure() {
        GroundTruth ground;
        truth = std::min(truth, milliseconds_of([&] { ground = trace(tracer); }));
        exact_decisions = ground.statistics.exact_decisions;
        judging = std::min(judging, milliseconds_of([&] {
                               const TracedScene traced(tracer, ground);
                               classify(traced, frame, *judge_of(traced, frame));
                           }));
    }
};

void print(const std::string& name, const Measured& odd, const Measured& ordinary) {
    fmt::print("{:<26}{:>10}{:>10.2f}{:>8.1f}{:>12.2f}{:>8.1f}{:>12}\n", name,
               odd.scene.triangles.size(), odd.truth, odd.truth / ordinary.truth, odd.judging,
               odd.judging / ordinary.judging, odd.exact_decisions);
}

void run(int rounds, const std::vector<std::string>& names) {
    Gpu gpu(GlPlatform::osmesa);
    fmt::print("{:<26}{:>10}{:>10}{:>8}{:>12}{:>8}{:>12}\n", "scene", "triangles", "truth ms",
               "ratio", "judging ms", "ratio", "exact");
    for (const Row& row : rows()) {
        Measured ordinary(row.front().make(), gpu);
        for (const Odd& odd : row) {
            if (!names.empty() && std::ranges::count(names, odd.name) == 0) continue;
            Measured measured(odd.make(), gpu);
            for (int round = 0; round < rounds; ++round) {
                ordinary.measure();
                measured.measure();
            }
            print(odd.name, measured, ordinary);
        }
    }
}

} // namespace
} // namespace shadowproof

int main(int argc, char** argv) {
    const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
    shadowproof::run(rounds, {argv + std::min(argc, 2), argv + argc});
}
