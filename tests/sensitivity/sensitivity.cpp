// What the judge catches: each fault of the catalogue on the bundled scenes until one catches it.
//   shadowproof_sensitivity [--scenes A,B] [--faults REGEX] [--size WxH] [-v]
// Prints a line for each fault: caught (where, by which verdict), escaped (where it changed most),
// or without effect. Exit code 1: a fault escaped, or one had no effect and is not said to be
// equal.
#include "compare/verdict.h"
#include "raster/gl/context.h"
#include "raster/technique.h"
#include "tests/compare/bundled_names.h"
#include "tests/compare/traced_scene.h"
#include "tests/sensitivity/faults.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <string>
#include <utility>
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
    std::uint64_t evidence = 0; ///< counters, or texels of a map
    std::uint64_t surfaces = 0; ///< triangles or depths
    std::uint64_t colors = 0;
    double largest_color = 0; ///< of 255
    bool of_map = false;      ///< evidence is of a map
    bool figures = false;     ///< fragments, or the picture of the volumes

    bool any() const { return claims > 0 || evidence > 0 || surfaces > 0 || colors > 0 || figures; }
    std::uint64_t size() const { return 1000 * claims + evidence + surfaces + colors; }
};

template <class Value>
std::uint64_t differing(const Image<Value>& a, const Image<Value>& b) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) count += a.pixels[i] != b.pixels[i] ? 1U : 0U;
    return count;
}

Effect effect_of(const Frame& right, const Frame& faulty) {
    Effect effect;
    effect.of_map = right.mapped.has_value();
    effect.claims = differing(right.claim, faulty.claim);
    if (right.counted) effect.evidence = differing(right.counted->counter, faulty.counted->counter);
    for (std::size_t face = 0; right.mapped && face < right.mapped->faces.size(); ++face)
        effect.evidence += differing(right.mapped->faces[face], faulty.mapped->faces[face]);
    effect.surfaces =
        std::max(differing(right.triangle, faulty.triangle), differing(right.depth, faulty.depth));
    effect.colors = differing(right.color, faulty.color);
    for (std::size_t i = 0; i < right.color.pixels.size(); ++i)
        for (int k = 0; k < 3; ++k)
            effect.largest_color =
                std::max(effect.largest_color, 255.0 * std::abs(double{right.color.pixels[i][k]} -
                                                                faulty.color.pixels[i][k]));
    if (!right.counted) return effect;
    const auto saved = [](const Frame& frame) {
        return frame.counted->saved ? frame.counted->saved->volume_fragments : 0;
    };
    effect.figures = saved(right) != saved(faulty) ||
                     right.counted->volume_fragments != faulty.counted->volume_fragments ||
                     differing(right.counted->volumes, faulty.counted->volumes) > 0;
    return effect;
}

std::string words_of(const Effect& effect) {
    std::string words = fmt::format("{} claims, {} {}, {} surfaces", effect.claims, effect.evidence,
                                    effect.of_map ? "texels" : "counters", effect.surfaces);
    if (effect.colors > 0)
        words +=
            fmt::format(", {} colours by up to {:.2f}/255", effect.colors, effect.largest_color);
    if (effect.figures) words += ", figures";
    return words;
}

/// A cell, and what a fault did there.
struct Finding {
    std::string place;   ///< "many_lights-fill/zpass"
    std::string verdict; ///< or "refused"
    std::string effect;
};

/// What has become of a fault so far.
struct Outcome {
    std::optional<Finding> caught;
    std::optional<Finding> escaped; ///< where it changed most without being caught
    std::uint64_t escaped_size = 0;
};

constexpr int width = 200; ///< of the pictures
constexpr int height = 200;

/// Named as it was asked for, as pictures of a size that is quickly judged.
Scene load(const std::string& name) {
    Scene scene = tests::load_named(name);
    scene.name = name;
    scene.camera.width = width;
    scene.camera.height = height;
    return scene;
}

/// Those of the bundled names that are of the chosen scenes; of none: all.
std::vector<std::string> scene_names(const std::vector<std::string>& chosen) {
    std::vector<std::string> names = tests::bundled_names();
    std::erase_if(names, [&](const std::string& name) {
        return !chosen.empty() &&
               std::ranges::find(chosen, name.substr(0, name.find('-'))) == chosen.end();
    });
    return names;
}

class Trial {
public:
    Trial(Scene scene, Gpu& gpu) : traced_(std::move(scene)), gpu_(gpu) {}

    const Scene& scene() const { return traced_.scene; }

    void run(int number, const Technique& technique, Outcome& outcome) {
        Finding finding{traced_.scene.name + "/" + std::string(technique.name), "", ""};
        try {
            const auto [verdict, effect] = tried(number, technique);
            finding.verdict = name_of(verdict);
            finding.effect = words_of(effect);
            if (verdict == Verdict::defect || verdict == Verdict::unexplained) {
                outcome.caught = finding;
            } else if (effect.any() && effect.size() >= outcome.escaped_size) {
                outcome.escaped_size = effect.size();
                outcome.escaped = finding;
            }
        } catch (const std::exception& error) {
            finding.verdict = "refused";
            finding.effect = error.what();
            outcome.caught = finding;
        }
    }

private:
    TracedScene traced_;
    Gpu& gpu_;
    std::map<std::string_view, Frame> right_;

    /// What a fault of the claim's side changes nothing of is not judged.
    std::pair<Verdict, Effect> tried(int number, const Technique& technique) {
        const Frame& unharmed = right(technique);
        const Fault& fault = faults::all_faults()[static_cast<std::size_t>(number)];
        if (fault.scope == faults::Scope::shared) {
            const Switched on(number);
            const TracedScene traced(traced_.scene);
            const Frame frame = render(technique, traced.scene, traced.plan, gpu_);
            return {judged(technique, traced, frame), effect_of(unharmed, frame)};
        }
        const Frame frame = [&] {
            const Switched on(number);
            return render(technique, traced_.scene, traced_.plan, gpu_);
        }();
        const Effect effect = effect_of(unharmed, frame);
        if (!effect.any()) return {Verdict::agrees, effect};
        return {judged(technique, traced_, frame), effect};
    }

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

/// Whether a name is in a list by commas; an empty list holds all.
bool holds_name(std::string_view list, std::string_view name) {
    if (list.empty()) return true;
    return ("," + std::string(list) + ",").find("," + std::string(name) + ",") != std::string::npos;
}

/// Tries faults until they are caught. `open`: one of each fault, 1 where it is to be tried.
std::vector<Outcome> explore(const std::vector<std::string>& scenes, std::vector<std::uint8_t> open,
                             bool verbose) {
    const std::span<const Fault> catalogue = faults::all_faults();
    std::vector<Outcome> outcomes(catalogue.size());
    Gpu gpu(GlPlatform::osmesa);
    for (const std::string& name : scenes) {
        Trial trial(load(name), gpu);
        for (std::size_t i = 0; i < catalogue.size(); ++i)
            for (const Technique& technique : all_techniques()) {
                if (open[i] == 0 || !holds_name(catalogue[i].scenes, name)) break;
                if (!suits(technique, trial.scene()) ||
                    !holds_name(catalogue[i].techniques, technique.name))
                    continue;
                trial.run(static_cast<int>(i), technique, outcomes[i]);
                if (outcomes[i].caught) open[i] = 0;
            }
        if (verbose) fmt::print(stderr, "{}: {} faults left\n", name, std::ranges::count(open, 1));
    }
    return outcomes;
}

std::string page_of(const std::vector<Outcome>& outcomes) {
    const std::span<const Fault> catalogue = faults::all_faults();
    std::string caught;
    std::string escaped;
    std::string without_effect;
    std::size_t count = 0;
    for (std::size_t i = 0; i < catalogue.size(); ++i) {
        const Fault& fault = catalogue[i];
        const Outcome& outcome = outcomes[i];
        if (outcome.caught) {
            ++count;
            caught +=
                fmt::format("| `{}` | {} | `{}` | {} | {} |\n", fault.name, fault.kind,
                            outcome.caught->place, outcome.caught->verdict, outcome.caught->effect);
        } else if (outcome.escaped) {
            escaped += fmt::format("| `{}` | {} | `{}` | {} | {} | {} |\n", fault.name, fault.kind,
                                   outcome.escaped->place, outcome.escaped->verdict,
                                   outcome.escaped->effect, fault.why);
        } else {
            without_effect +=
                fmt::format("| `{}` | {} | {} |\n", fault.name, fault.kind, fault.why);
        }
    }
    return fmt::format(
        "# What the judge catches\n\n"
        "`unexplained 0` means something only if faults are not explained away. This page is "
        "written\n"
        "by `shadowproof_sensitivity --page docs/sensitivity.md`, which builds {} faults into the\n"
        "techniques, one at a time, and lets the judge look at each technique on each bundled "
        "scene\n"
        "at {}x{} until a cell fails. The faults stand in `tests/sensitivity/catalogue/`, no "
        "release\n"
        "holds them, and the test `sensitivity` tries each where this page says that it is "
        "caught.\n\n"
        "Faults of the kind *shared* are in code that techniques and judge have in common, and "
        "are\n"
        "switched on for both; all others are on while the technique draws.\n\n"
        "## Caught: {}\n\n"
        "| fault | of | on | verdict | what it changes there |\n|---|---|---|---|---|\n{}\n"
        "## Not caught\n\nWhere each changes most.\n\n"
        "| fault | of | on | verdict | what it changes there | why "
        "|\n|---|---|---|---|---|---|\n{}\n"
        "## Without effect on any bundled scene\n\n"
        "Byte for byte: claims, counters, surfaces, depths, colours and figures.\n\n"
        "| fault | of | why |\n|---|---|---|\n{}",
        catalogue.size(), width, height, count, caught, escaped, without_effect);
}

/// The places of a page's first table, by fault.
std::map<std::string, std::string> places_of(const std::string& file) {
    std::ifstream stream(file);
    std::map<std::string, std::string> places;
    const std::regex row(
        R"(\| `(\w[^`]*)` \| \w+ \| `([^`]+)` \| (defect|unexplained|refused) .*)");
    std::smatch match;
    for (std::string line; std::getline(stream, line);)
        if (std::regex_match(line, match, row)) places[match[1]] = match[2];
    return places;
}

/// Whether each fault of the page is caught where it says, and no fault of it is gone.
bool holds(const std::string& file) {
    const std::span<const Fault> catalogue = faults::all_faults();
    const std::map<std::string, std::string> places = places_of(file);
    std::map<std::string, std::vector<std::size_t>> by_scene;
    for (std::size_t i = 0; i < catalogue.size(); ++i)
        if (const auto place = places.find(std::string(catalogue[i].name)); place != places.end())
            by_scene[place->second.substr(0, place->second.find('/'))].push_back(i);
    std::size_t caught = 0;
    Gpu gpu(GlPlatform::osmesa);
    for (const auto& [scene, numbers] : by_scene) {
        Trial trial(load(scene), gpu);
        for (const std::size_t i : numbers) {
            const std::string& place = places.at(std::string(catalogue[i].name));
            const Technique* technique = find_technique(place.substr(place.find('/') + 1));
            Outcome outcome;
            if (technique != nullptr) trial.run(static_cast<int>(i), *technique, outcome);
            if (outcome.caught)
                ++caught;
            else
                fmt::print("{} is not caught on {}\n", catalogue[i].name, place);
        }
    }
    fmt::print("{} of {} faults are caught\n", caught, places.size());
    return caught == places.size() && !places.empty();
}

void print_outcomes(const std::vector<Outcome>& outcomes, const std::vector<std::uint8_t>& chosen) {
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        if (chosen[i] == 0) continue;
        const Outcome& outcome = outcomes[i];
        const std::optional<Finding>& finding = outcome.caught ? outcome.caught : outcome.escaped;
        const char* const word =
            outcome.caught ? "caught" : (outcome.escaped ? "ESCAPED" : "no effect");
        fmt::print("{:9} {:34} {}\n", word, faults::all_faults()[i].name,
                   finding ? finding->place + " " + finding->verdict + " (" + finding->effect + ")"
                           : "");
    }
}

} // namespace
} // namespace shadowproof

int main(int argc, char** argv) {
    using namespace shadowproof;
    CLI::App app("What the judge catches", "shadowproof_sensitivity");
    std::vector<std::string> scenes;
    std::string pattern = ".";
    std::string page;
    std::string held;
    bool verbose = false;
    app.add_option("--scenes", scenes, "bundled scenes, by commas; all")->delimiter(',');
    app.add_option("--faults", pattern, "a regular expression of names");
    app.add_option("--page", page, "the page to write");
    app.add_option("--hold", held, "the page whose faults are tried where it says");
    app.add_flag("-v", verbose, "say how far it is");
    CLI11_PARSE(app, argc, argv);
    if (!held.empty()) return holds(held) ? 0 : 1;
    std::vector<std::uint8_t> chosen;
    for (const faults::Fault& fault : faults::all_faults())
        chosen.push_back(std::regex_search(std::string(fault.name), std::regex(pattern)) ? 1 : 0);
    const std::vector<Outcome> outcomes = explore(scene_names(scenes), chosen, verbose);
    print_outcomes(outcomes, chosen);
    if (!page.empty()) std::ofstream(page) << page_of(outcomes);
    return 0;
}
