// The settings that are swept: those that trade error for time. A line of the table for each.
#pragma once

#include "compare/bench/bench_run.h"
#include "compare/command/options.h"
#include "raster/technique.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace shadowproof {

/// A setting that has a flag of its own (add_technique_flags). Its values are the flag's.
struct SweptSetting {
    std::string_view name; ///< of the flag, without its dashes
    std::vector<std::string_view> values;
    /// The value by which a frame was made, as the flag would have it. `unit`: Scene::unit.
    std::string (*own)(const Frame& frame, double unit);
    std::vector<std::string_view> costly{}; ///< values that take seconds each: not with --quick
    /// Further values: so many times the technique's own, where lengths fit a scene and no other.
    std::vector<double> factors{};
};

/// All of them, in the order in which they are swept.
std::span<const SweptSetting> swept_settings();

/// The options with these settings, read by the flags themselves. Throws CLI::ParseError where a
/// flag does not know a value.
TechniqueOptions with_settings(TechniqueOptions options, const BenchSettings& settings);

/// What a technique takes by itself, by a frame that it made without any setting.
BenchSettings own_settings(const Technique& technique, const Frame& frame, double unit);

/// One setting at a time, each value but the technique's own, and but the costly ones where it is
/// to be `quick`; settings in `fixed` stay.
std::vector<BenchSettings> sweep(const Technique& technique, const BenchSettings& fixed,
                                 const BenchSettings& own, bool quick);

/// Those swept settings that flags of a parsed command line have set.
BenchSettings fixed_settings(const CLI::App& command);

} // namespace shadowproof
