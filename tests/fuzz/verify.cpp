// The whole way of a small scene: loaded, traced, drawn by a robust stencil technique and a second
// one, judged. An unexplained pixel, a defect of a robust technique and too much time are broken
// promises. With SHADOWPROOF_FUZZ_FINDINGS=FOLDER these are kept there, few of each kind, and the
// run goes on.
#include "compare/blank.h"
#include "compare/classify.h"
#include "compare/families.h"
#include "compare/verdict.h"
#include "raster/render.h"
#include "scenes/error.h"
#include "scenes/load/admission.h"
#include "scenes/load/gltf/gltf.h"
#include "scenes/plan/plan.h"
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
            judge(truth.scene, technique.fails_at, technique.by_nature, comparison);
        if (verdict == Verdict::unexplained || (robust && verdict == Verdict::defect))
            return kind_of(technique, verdict, comparison);
    } catch (const Error& error) {
        if (const auto fault = fuzz::fault_of_message(error.what(), ""))
            return std::string(technique.name) + "-" + *fault;
        return std::string(technique.name) + "-error";
    }
    return std::nullopt;
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    const fuzz::Input input(bytes, size);
    static const fuzz::PrivateFolder folder;
    static Gpu gpu(GlPlatform::osmesa);
    const std::filesystem::path file = folder.write("asset.gltf", input);
    SceneRequest request;
    request.every_light = true;
    request.width = 24;
    request.height = 24;
    Scene scene;
    std::optional<Truth> truth;
    const fuzz::TimePromise promise("verify", input, 1);
    try {
        scene = load_gltf(file, request);
        // Only what a scene declares is held against those that fail: these declare nothing.
        scene.declares_provokes = false;
        if (scene.triangles.size() > most_triangles) return -1;
        admit(scene);
        truth.emplace(scene);
    } catch (const Error& error) {
        fuzz::check_message(error.what(), file.string(), "verify", input);
        return 0;
    }
    const char* second = is_bump_lit(scene) && !scene.environment ? "bump_tangent_space" : "zpass";
    for (const char* name : {"zfail_reversed", second}) {
        const bool robust = std::string_view(name) != "zpass";
        if (const auto kind = judged(*truth, *find_technique(name), robust, gpu))
            fuzz::report_finding(*kind + traits_of(scene, truth->plan), input);
    }
    return 0;
}
