#include "compare/command/verify/costs.h"

#include "scenes/load/catalog.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <system_error>

namespace shadowproof {

namespace {

/// Cells cost twice as much on a scene of so many triangles as on one of a few: between the medians
/// of bundled scenes with 2,400 and 11,000 (scenes/bundled/costs.json).
constexpr double doubling_triangles = 8000;

/// The technique's place is taken by a scene's own cost.
constexpr const char* no_technique = "";

double growth(double triangles) {
    return 1 + triangles / doubling_triangles;
}

std::optional<double> number_in(const ResultsJson& object, const char* name) {
    const auto found = object.find(name);
    if (found == object.end() || !found->is_number()) return std::nullopt;
    const auto value = found->get<double>();
    if (!(value >= 0) || !std::isfinite(value)) return std::nullopt;
    return value;
}

std::optional<std::string> name_in(const ResultsJson& object) {
    if (!object.is_object()) return std::nullopt;
    const auto found = object.find("name");
    if (found == object.end() || !found->is_string()) return std::nullopt;
    return found->get<std::string>();
}

std::uint64_t microseconds(double milliseconds) {
    constexpr double most = 1e12; // eleven days: many of them can be added up
    return static_cast<std::uint64_t>(std::clamp(1000 * milliseconds, 1.0, most));
}

const ResultsJson& list_in(const ResultsJson& object, const char* name) {
    static const ResultsJson none = ResultsJson::array();
    const auto found = object.find(name);
    return found != object.end() && found->is_array() ? *found : none;
}

} // namespace

void Costs::add(const ResultsJson& measured) {
    for (const ResultsJson& scene : list_in(measured, "scenes")) {
        const std::optional<std::string> name = name_in(scene);
        if (!name) continue;
        const double grown = growth(number_in(scene, "triangles").value_or(0));
        const auto keep = [&](double& place, const std::string& technique, double spent) {
            place = spent;
            plain_[technique][*name] = spent / grown;
        };
        if (const auto spent = number_in(scene, "spent_ms"))
            keep(scenes_[*name], no_technique, *spent);
        for (const ResultsJson& cell : list_in(scene, "techniques"))
            if (const auto technique = name_in(cell))
                if (const auto spent = number_in(cell, "spent_ms"))
                    keep(cells_[*name][*technique], *technique, *spent);
    }
}

/// The median of what is known of it; where nothing is, of all techniques' medians.
double Costs::usual(const std::string& technique) const {
    const auto median = [](std::vector<double> values) {
        if (values.empty()) return 1.0;
        const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        return *middle;
    };
    const auto values_of = [](const Milliseconds& by_scene) {
        std::vector<double> values;
        for (const auto& [scene, value] : by_scene) values.push_back(value);
        return values;
    };
    const auto known = plain_.find(technique);
    if (known != plain_.end()) return median(values_of(known->second));
    std::vector<double> medians;
    for (const auto& [name, by_scene] : plain_)
        if (name != no_technique) medians.push_back(median(values_of(by_scene)));
    return median(std::move(medians));
}

std::uint64_t Costs::of_cell(const std::string& scene, const std::string& technique,
                             std::uint64_t triangles) const {
    if (const auto known = cells_.find(scene); known != cells_.end())
        if (const auto cell = known->second.find(technique); cell != known->second.end())
            return microseconds(cell->second);
    return microseconds(usual(technique) * growth(static_cast<double>(triangles)));
}

std::uint64_t Costs::of_scene(const std::string& scene, std::uint64_t triangles) const {
    if (const auto known = scenes_.find(scene); known != scenes_.end())
        return microseconds(known->second);
    return microseconds(usual(no_technique) * growth(static_cast<double>(triangles)));
}

ResultsJson bundled_costs() {
    const std::filesystem::path file = bundled_folder() / "costs.json";
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return ResultsJson::object();
    constexpr JsonRemedies remedies{"install shadowproof again", "install shadowproof again"};
    return parse_json(json_text(file, remedies), file.string(), remedies);
}

} // namespace shadowproof
