#include "scenes/stress/parameter.h"

#include "scenes/error.h"
#include "scenes/stress/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace shadowproof {

std::span<const StressParameter> stress_parameters() {
    static const std::vector<StressParameter> all = [] {
        std::vector<StressParameter> parameters = view_parameters();
        for (const auto& more :
             {light_parameters(), geometry_parameters(), triangle_parameters(), map_parameters()})
            parameters.insert(parameters.end(), more.begin(), more.end());
        return parameters;
    }();
    return all;
}

const StressParameter* find_parameter(std::string_view name) {
    const std::span<const StressParameter> all = stress_parameters();
    const auto found =
        std::ranges::find_if(all, [&](const StressParameter& each) { return each.name == name; });
    return found == all.end() ? nullptr : &*found;
}

std::vector<double> ladder(const StressParameter& parameter, const Scene& scene, bool up,
                           int steps) {
    const std::optional<double>& end = up ? parameter.high : parameter.low;
    const double own = parameter.own(scene);
    if (!end || !(up ? own < *end : own > *end)) return {};
    const double decades = std::abs(std::log10(*end / own));
    const double step = std::max(1.0, std::ceil(decades / steps));
    std::vector<double> values;
    for (double decade = 0; decade < decades; decade += step)
        values.push_back(up ? *end / std::pow(10.0, decade) : *end * std::pow(10.0, decade));
    // The one nearest the scene's own value shows nothing that this does not.
    if (values.size() > 1 && std::abs(std::log10(values.back() / own)) < 0.3) values.pop_back();
    std::ranges::reverse(values);
    for (double& value : values) value = std::strtod(fmt::format("{:.3g}", value).c_str(), nullptr);
    if (parameter.whole)
        for (double& value : values) value = std::max(1.0, std::round(value));
    if (!up && parameter.down_to_zero) values.push_back(0);
    return values;
}

namespace {

/// Of all parameters, or of those that suit a scene.
std::string parameter_names(const Scene* scene = nullptr) {
    std::string names;
    for (const StressParameter& each : stress_parameters())
        if (scene == nullptr || (each.take != nullptr && each.suits(*scene)))
            names += (names.empty() ? "" : ", ") + std::string(each.name);
    return names;
}

/// Whether the parameter's range holds the value; the scene's own values are let through.
bool has_value(const StressParameter& parameter, const Scene& scene, double value) {
    if (parameter.whole && value != std::round(value)) return false;
    if (value == 0) return parameter.down_to_zero;
    const double own = parameter.own(scene);
    return value >= std::min(own, parameter.low.value_or(own)) &&
           value <= std::max(own, parameter.high.value_or(own));
}

} // namespace

Scene stressed(Scene scene, const Stress& stress) {
    const StressParameter* const parameter = find_parameter(stress.parameter);
    const std::string words = "--stress " + words_of(stress);
    if (parameter == nullptr)
        throw Error(words, "there is no such parameter", "take one of " + parameter_names());
    if (parameter->take == nullptr)
        throw Error(words, "is a setting of techniques",
                    fmt::format("give --{} instead", parameter->flag));
    if (!parameter->suits(scene))
        throw Error(words, fmt::format("does not suit scene {}", scene.name),
                    "leave it out, or take one of " + parameter_names(&scene));
    if (!has_value(*parameter, scene, stress.value))
        throw Error(words, "is out of range",
                    fmt::format("its values are {}{}, from {} to {}", parameter->words,
                                parameter->whole ? ", whole" : "",
                                parameter->low.value_or(parameter->own(scene)),
                                parameter->high.value_or(parameter->own(scene))));
    parameter->take(scene, stress.value);
    scene.provokes.clear();
    scene.may_provoke.clear();
    scene.declares_provokes = false;
    scene.notes.push_back(
        fmt::format("{} is {}: {}", parameter->name, stress.value, parameter->words));
    return scene;
}

std::string words_of(const Stress& stress) {
    return fmt::format("{}={}", stress.parameter, stress.value);
}

} // namespace shadowproof
