// The whole way of a small scene: loaded, traced, drawn by a robust stencil technique and a second
// one, judged. An unexplained pixel, a defect of a robust technique, too much time, and memory
// beyond what was estimated are broken promises. With SHADOWPROOF_FUZZ_FINDINGS=FOLDER these are
// kept there, few of each kind, and the run goes on.
#include "compare/blank.h"
#include "compare/classify.h"
#include "compare/families.h"
#include "compare/memory.h"
#include "compare/verdict.h"
#include "raster/render.h"
#include "scenes/error.h"
#include "scenes/load/admission.h"
#include "scenes/load/gltf/gltf.h"
#include "scenes/plan/plan.h"
#include "tests/fuzz/allocations.h"
#include "tests/fuzz/findings.h"
#include "tests/fuzz/private_folder.h"
#include "tests/fuzz/promises.h"
#include "tests/fuzz/target.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

namespace {

using namespace shadowproof;

constexpr std::size_t most_triangles = 600; ///< more show nothing else, and slow the search down
/// What OpenGL in software, the compiler of its shaders and Embree allocate whatever the scene:
/// measured, 12.4 MB for the first input and 6 for the others, and a quarter.
constexpr std::uint64_t driver_bytes = 16'000'000;

struct Truth {
    const Scene& scene;
    Plan plan;
    Tracer tracer;
    GroundTruth truth;
    TracedScene traced;

    explicit Truth(const Scene& given)
        : scene(given), plan(make_plan(scene)), tracer(scene, 1), truth(trace(tracer)),
          traced(tracer, truth) {}
    Truth(const Truth&) = delete; // what is traced refers to the tracer
    Truth& operator=(const Truth&) = delete;
};

/// What is odd about a scene, so that what is known of one kind of scene does not hide another's
/// findings: "-large-near".
std::string traits_of(const Scene& scene, const Plan& plan) {
    double largest = 0;
    double shortest = std::numeric_limits<double>::infinity();
    bool has_area = true;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        const glm::dvec3 a = corner(scene, t, 0);
        const glm::dvec3 normal = glm::cross(corner(scene, t, 1) - a, corner(scene, t, 2) - a);
        has_area = has_area && normal != glm::dvec3(0);
        for (int k = 0; k < 3; ++k) {
            largest = std::max(largest, glm::length(corner(scene, t, k) - scene.camera.eye));
            const double side = glm::length(corner(scene, t, (k + 1) % 3) - corner(scene, t, k));
            if (side > 0) shortest = std::min(shortest, side);
        }
    }
    std::string traits;
    if (largest > 1000) traits += "-large";
    if (shortest < 1e-4) traits += "-tiny";
    if (!has_area) traits += "-flat";
    if (scene.camera.near < 1e-3) traits += "-near";
    if (scene.camera.far < 1e3) traits += "-far";
    if (std::count(plan.around_light.begin(), plan.around_light.end(), 1) > 0) traits += "-around";
    return traits;
}

/// "zpass-unexplained-unexplained", "zfail_reversed-defect-near_plane", "...-counters"
std::string kind_of(const Technique& technique, Verdict verdict, const Comparison& comparison) {
    std::string kind = std::string(technique.name) + "-" + std::string(name_of(verdict));
    for (const CauseWords& words : all_causes)
        if (words.cause != Cause::edge &&
            comparison.causes[static_cast<std::size_t>(words.cause)] > 0)
            kind += "-" + std::string(name_of(words.cause));
    if (comparison.evidence.unexplained > 0) kind += "-counters";
    if (comparison.colors && comparison.colors->unpredicted > 0) kind += "-colors";
    return kind;
}

/// A kind of broken promise, or nothing.
std::optional<std::string> judged(const Truth& truth, const Technique& technique, bool robust,
                                  Gpu& gpu) {
    try {
        const Frame frame = render(technique, truth.scene, truth.plan, gpu);
        const Comparison comparison = classify(truth.traced, frame, *judge_of(truth.traced, frame));
        refuse_blank(technique.name, truth.truth, frame,
                     pixels_of(comparison, Cause::unexplained) > 0);
        const Verdict verdict =
            judge(truth.scene, known_on(truth.scene, frame, technique.fails_at),
                  known_on(truth.scene, frame, technique.by_nature), comparison);
        if (verdict == Verdict::unexplained || (robust && verdict == Verdict::defect))
            return kind_of(technique, verdict, comparison);
    } catch (const Error& error) {
        if (const auto fault = fuzz::fault_of_message(error.what(), ""))
            return std::string(technique.name) + "-" + *fault;
        return std::string(technique.name) + "-error";
    }
    return std::nullopt;
}

/// Loaded at the size of a stamp, within a budget that it must keep.
Scene load(const std::filesystem::path& file, const fuzz::Input& input) {
    constexpr std::uint64_t promised = 100'000'000; // bytes
    SceneRequest request;
    request.every_light = true;
    request.width = 24;
    request.height = 24;
    request.memory = {program_bytes + promised, "the fuzzer"};
    const fuzz::PeakAllocation peak;
    Scene scene = load_gltf(file, request);
    if (peak.bytes() > promised) fuzz::report_finding("verify-load-memory", input);
    return scene;
}

/// Traced and judged with two techniques.
void verify(const Scene& scene, Gpu& gpu, const fuzz::Input& input) {
    const fuzz::PeakAllocation peak;
    const Truth truth(scene);
    const char* second = is_bump_lit(scene) && !scene.environment ? "bump_tangent_space" : "zpass";
    for (const char* name : {"zfail_reversed", second}) {
        const bool robust = std::string_view(name) != "zpass";
        if (const auto kind = judged(truth, *find_technique(name), robust, gpu))
            fuzz::report_finding(*kind + traits_of(scene, truth.plan), input);
    }
    if (peak.bytes() > scene_bytes(scene, Workload::comparison) + driver_bytes)
        fuzz::report_finding("verify-memory", input);
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    const fuzz::Input input(bytes, size);
    static const fuzz::PrivateFolder folder;
    static Gpu gpu(GlPlatform::osmesa);
    const std::filesystem::path file = folder.write("asset.gltf", input);
    const fuzz::TimePromise promise("verify", input, 1);
    try {
        Scene scene = load(file, input);
        // Only what a scene declares is held against those that fail: these declare nothing.
        scene.declares_provokes = false;
        if (scene.triangles.size() > most_triangles) return -1;
        admit(scene);
        verify(scene, gpu, input);
    } catch (const Error& error) {
        fuzz::check_message(error.what(), file.string(), "verify", input);
    }
    return 0;
}
