#include "tests/sensitivity/trial.h"

#include "tests/scenes/bundled_names.h"

#include <algorithm>
#include <exception>
#include <stdexcept>

namespace shadowproof {

namespace {

using faults::Fault;

/// While this lives, a fault is switched on.
struct Switched {
    Switched(int fault, double amount) {
        faults::amount = amount;
        faults::active = fault;
    }
    ~Switched() { faults::active = faults::none; }
    Switched(const Switched&) = delete;
    Switched& operator=(const Switched&) = delete;
};

/// Whether a name is in a list by commas; an empty list holds all.
bool holds_name(std::string_view list, std::string_view name) {
    if (list.empty()) return true;
    return ("," + std::string(list) + ",").find("," + std::string(name) + ",") != std::string::npos;
}

Verdict judged(const Technique& technique, const tests::TracedScene& traced, const Frame& frame) {
    return judge(traced.scene, known_on(traced.scene, frame, technique.fails_at),
                 known_on(traced.scene, frame, technique.by_nature),
                 tests::compared(traced, frame));
}

} // namespace

Scene load_to_try(const std::string& name) {
    Scene scene = tests::load_named(name);
    scene.name = name;
    scene.camera.width = tried_width;
    scene.camera.height = tried_height;
    return scene;
}

std::vector<std::string> scene_names(const std::vector<std::string>& chosen) {
    std::vector<std::string> names = tests::bundled_names();
    std::erase_if(names, [&](const std::string& name) {
        return !chosen.empty() &&
               std::ranges::find(chosen, name.substr(0, name.find('-'))) == chosen.end();
    });
    return names;
}

bool concerns(const Fault& fault, const Technique& technique, const Scene& scene) {
    return holds_name(fault.scenes, scene.name) && holds_name(fault.techniques, technique.name) &&
           suits(technique, scene);
}

void Trial::run(int number, const Technique& technique, Outcome& outcome, double amount) {
    right(technique); // or nothing that is caught counts
    TriedCell finding{traced_.scene.name + "/" + std::string(technique.name), "", ""};
    try {
        const auto [verdict, effect] = tried(number, technique, amount);
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

/// What a fault of the claim's side changes nothing of is not judged.
std::pair<Verdict, Effect> Trial::tried(int number, const Technique& technique, double amount) {
    const Frame& unharmed = right(technique);
    const Fault& fault = faults::all_faults()[static_cast<std::size_t>(number)];
    if (fault.scope == faults::Scope::shared) {
        const Switched on(number, amount);
        const tests::TracedScene traced(traced_.scene);
        const Frame frame = render(technique, traced.scene, traced.plan, gpu_);
        return {judged(technique, traced, frame), effect_of(unharmed, frame)};
    }
    const Frame frame = [&] {
        const Switched on(number, amount);
        return render(technique, traced_.scene, traced_.plan, gpu_);
    }();
    const Effect effect = effect_of(unharmed, frame);
    if (!effect.any()) return {Verdict::agrees, effect};
    return {judged(technique, traced_, frame), effect};
}

const Frame& Trial::right(const Technique& technique) {
    const auto known = right_.find(technique.name);
    if (known != right_.end()) return known->second;
    Frame frame = render(technique, traced_.scene, traced_.plan, gpu_);
    const Verdict verdict = judged(technique, traced_, frame);
    if (verdict == Verdict::defect || verdict == Verdict::unexplained)
        throw std::logic_error(traced_.scene.name + "/" + std::string(technique.name) + ": " +
                               std::string(name_of(verdict)) + " without any fault");
    return right_.emplace(technique.name, std::move(frame)).first->second;
}

} // namespace shadowproof
