// What the judge catches: each fault of the catalogue on the bundled scenes until one catches it.
//   shadowproof_sensitivity [--scenes A,B] [--faults REGEX] [--size WxH] [-v]
// Prints a line for each fault: caught (where, by which verdict), escaped (where it changed most),
// or without effect. Exit code 1: a fault escaped, or one had no effect and is not said to be
// equal.
#include "compare/verdict.h"
#include "raster/context.h"
#include "raster/technique.h"
#include "scenes/catalog.h"
#include "tests/compare/traced_scene.h"
#include "tests/sensitivity/faults.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <regex>
#include <string>
#include <vector>

namespace shadowproof {
namespace {

using faults::Fault;
using tests::TracedScene;

/// While this lives, a fault is switched on.
struct Switched {
    explicit Switched(int fault) { faults::active = fault; }
    ~Switched() { faults::active = faults::none; }
    Switched(const Switched&) = delete;
    Switched& operator=(const Switched&) = delete;
};

/// How far a faulty frame is from the right one.
struct Effect {
    std::uint64_t claims = 0;
    std::uint64_t counters = 0;
    std::uint64_t surfaces = 0; ///< triangles or depths
    std::uint64_t colors = 0;
    double largest_color = 0; ///< of 255
    bool figures = false;     ///< fragments, or the picture of the volumes

    bool any() const { return claims > 0 || counters > 0 || surfaces > 0 || colors > 0 || figures; }
    std::uint64_t size() const { return 1000 * claims + counters + surfaces + colors; }
};

template <class Value>
std::uint64_t differing(const Image<Value>& a, const Image<Value>& b) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) count += a.pixels[i] != b.pixels[i] ? 1U : 0U;
    return count;
}

Effect effect_of(const Frame& right, const Frame& faulty) {
    Effect effect;
    effect.claims = differing(right.claim, faulty.claim);
    effect.counters = differing(right.counter, faulty.counter);
    effect.surfaces =
        std::max(differing(right.triangle, faulty.triangle), differing(right.depth, faulty.depth));
    effect.colors = differing(right.color, faulty.color);
    for (std::size_t i = 0; i < right.color.pixels.size(); ++i)
        for (int k = 0; k < 3; ++k)
            effect.largest_color =
                std::max(effect.largest_color, 255.0 * std::abs(double{right.color.pixels[i][k]} -
                                                                faulty.color.pixels[i][k]));
    effect.figures = right.volume_fragments != faulty.volume_fragments ||
                     differing(right.volumes, faulty.volumes) > 0;
    return effect;
}

std::string words_of(const Effect& effect) {
    std::string words = fmt::format("{} claims, {} counters, {} surfaces", effect.claims,
                                    effect.counters, effect.surfaces);
    if (effect.colors > 0)
        words +=
            fmt::format(", {} colours by up to {:.2f}/255", effect.colors, effect.largest_color);
    if (effect.figures) words += ", figures";
    return words;
}

/// What has become of a fault so far.
struct Outcome {
    std::string caught;  ///< where, by which verdict; empty: nowhere yet
    std::string escaped; ///< where it changed most without being caught
    std::uint64_t escaped_size = 0;
    int cells = 0;
    int effective = 0;
};

class Trial {
public:
    Trial(Scene scene, Gpu& gpu) : traced_(std::move(scene)), gpu_(gpu) {}

    const Scene& scene() const { return traced_.scene; }

    void run(int number, const Technique& technique, Outcome& outcome) {
        const Fault& fault = faults::all_faults()[static_cast<std::size_t>(number)];
        const Frame& unharmed = right(technique);
        ++outcome.cells;
        const std::string place = traced_.scene.name + "/" + std::string(technique.name);
        try {
            std::optional<Verdict> verdict;
            Effect effect;
            if (fault.scope == faults::Scope::claim) {
                std::optional<Frame> frame;
                {
                    const Switched on(number);
                    frame = render(technique, traced_.scene, traced_.plan, gpu_);
                }
                effect = effect_of(unharmed, *frame);
                if (!effect.any()) return;
                verdict = judged(technique, traced_, *frame);
            } else {
                const Switched on(number);
                const TracedScene traced(traced_.scene);
                const Frame frame = render(technique, traced.scene, traced.plan, gpu_);
                effect = effect_of(unharmed, frame);
                // The fault may be the judge's: then the claim is as it was, and the verdict tells.
                verdict = judged(technique, traced, frame);
                if (!effect.any() && *verdict != Verdict::defect &&
                    *verdict != Verdict::unexplained)
                    return;
            }
            ++outcome.effective;
            if (*verdict == Verdict::defect || *verdict == Verdict::unexplained) {
                outcome.caught =
                    fmt::format("{} {} ({})", place, name_of(*verdict), words_of(effect));
            } else if (effect.size() >= outcome.escaped_size) {
                outcome.escaped_size = effect.size();
                outcome.escaped =
                    fmt::format("{} {} ({})", place, name_of(*verdict), words_of(effect));
            }
        } catch (const std::exception& error) {
            ++outcome.effective;
            outcome.caught = fmt::format("{} refused: {}", place, error.what());
        }
    }

private:
    TracedScene traced_;
    Gpu& gpu_;
    std::map<std::string_view, Frame> right_;

    static Verdict judged(const Technique& technique, const TracedScene& traced,
                          const Frame& frame) {
        return judge(traced.scene, technique.fails_at, technique.by_nature,
                     tests::compared(traced, frame));
    }
    const Frame& right(const Technique& technique) {
        const auto known = right_.find(technique.name);
        if (known != right_.end()) return known->second;
        return right_.emplace(technique.name, render(technique, traced_.scene, traced_.plan, gpu_))
            .first->second;
    }
};

bool tried_with(const Fault& fault, std::string_view technique) {
    if (fault.techniques.empty()) return true;
    const std::string list = "," + std::string(fault.techniques) + ",";
    return list.find("," + std::string(technique) + ",") != std::string::npos;
}

int run(const std::vector<std::string>& scenes, const std::string& chosen, int width, int height,
        bool verbose) {
    const std::span<const Fault> catalogue = faults::all_faults();
    const std::regex pattern(chosen);
    std::vector<Outcome> outcomes(catalogue.size());
    std::vector<std::uint8_t> open(catalogue.size());
    for (std::size_t i = 0; i < catalogue.size(); ++i)
        open[i] = std::regex_search(std::string(catalogue[i].name), pattern) ? 1 : 0;
    Gpu gpu(GlPlatform::osmesa);
    for (const std::string& name : scenes) {
        if (std::ranges::count(open, 1) == 0) break;
        SceneRequest request;
        request.every_light = true;
        const std::size_t lights = load_scene(name, request).lights.size();
        for (std::size_t light = 0; light < lights; ++light) {
            Scene scene = load_scene(name, request);
            scene.light = static_cast<std::uint32_t>(light);
            scene.camera.width = width;
            scene.camera.height = height;
            Trial trial(std::move(scene), gpu);
            for (std::size_t i = 0; i < catalogue.size(); ++i) {
                for (const Technique& technique : all_techniques()) {
                    if (open[i] == 0) break;
                    if (!suits(technique, trial.scene()) ||
                        !tried_with(catalogue[i], technique.name))
                        continue;
                    trial.run(static_cast<int>(i), technique, outcomes[i]);
                    if (!outcomes[i].caught.empty()) open[i] = 2;
                    if (open[i] == 2) break;
                }
                if (open[i] == 2) open[i] = 0;
            }
        }
        if (verbose) fmt::print(stderr, "{}: {} faults left\n", name, std::ranges::count(open, 1));
    }
    int failing = 0;
    for (std::size_t i = 0; i < catalogue.size(); ++i) {
        const Fault& fault = catalogue[i];
        const Outcome& outcome = outcomes[i];
        if (!std::regex_search(std::string(fault.name), pattern)) continue;
        const bool is_equal = outcome.effective == 0;
        const bool fails = outcome.caught.empty() && (!is_equal || fault.equal.empty());
        failing += fails ? 1 : 0;
        fmt::print("{:9} {:34} {}\n",
                   !outcome.caught.empty() ? "caught" : (is_equal ? "no effect" : "ESCAPED"),
                   fault.name, !outcome.caught.empty() ? outcome.caught : outcome.escaped);
    }
    fmt::print("{} of {} faults fail\n", failing,
               std::ranges::count_if(catalogue, [&](const Fault& fault) {
                   return std::regex_search(std::string(fault.name), pattern);
               }));
    return failing == 0 ? 0 : 1;
}

} // namespace
} // namespace shadowproof

int main(int argc, char** argv) {
    using namespace shadowproof;
    CLI::App app("What the judge catches", "shadowproof_sensitivity");
    std::vector<std::string> scenes;
    std::string chosen = ".";
    std::string size = "256x256";
    bool verbose = false;
    app.add_option("--scenes", scenes, "bundled scenes, by commas; all")->delimiter(',');
    app.add_option("--faults", chosen, "a regular expression of names");
    app.add_option("--size", size, "of the pictures");
    app.add_flag("-v", verbose, "say how far it is");
    CLI11_PARSE(app, argc, argv);
    if (scenes.empty())
        for (const BundledScene& scene : bundled_scenes()) scenes.emplace_back(scene.name);
    int width = 0;
    int height = 0;
    if (std::sscanf(size.c_str(), "%dx%d", &width, &height) != 2) return 2;
    return run(scenes, chosen, width, height, verbose);
}
