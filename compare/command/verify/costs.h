// What the cells of a run cost, by what they have cost before.
#pragma once

#include "compare/json/json_file.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace shadowproof {

/// Microseconds of time on the machine that measured them: only their ratios count.
class Costs {
public:
    /// Adds what a run has measured: of results.json, or costs.json of the bundled scenes, the
    /// times that scenes and cells took ("spent_ms"). It takes the place of what is known of them.
    /// Times that are missing, or no times, are passed over.
    void add(const ResultsJson& measured);

    /// Of a cell; where it was never measured, as the technique costs elsewhere and by the scene's
    /// triangles. At least 1.
    std::uint64_t of_cell(const std::string& scene, const std::string& technique,
                          std::uint64_t triangles) const;
    /// Of a scene under one light before its cells: reading, tracing, writing its truth.
    std::uint64_t of_scene(const std::string& scene, std::uint64_t triangles) const;

private:
    using Milliseconds = std::map<std::string, double, std::less<>>; ///< by technique
    std::map<std::string, Milliseconds, std::less<>> cells_;         ///< by scene
    Milliseconds scenes_;
    /// What each measurement would be on a scene without triangles.
    std::map<std::string, Milliseconds, std::less<>> plain_; ///< by technique, and scene

    double usual(const std::string& technique) const;
};

/// What the bundled scenes cost at 512x512, as measured by tests/bench/costs.mjs; nothing where
/// that is not installed. Throws Error where it is damaged.
ResultsJson bundled_costs();

} // namespace shadowproof
