// Parameters along which a scene is taken from harmless to absurd. Values have no unit, or are in
// sizes of the scene, so that they mean the same in any scene.
#pragma once

#include "scenes/scene.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace shadowproof {

struct StressParameter {
    std::string_view name;  ///< "near_plane"
    std::string_view words; ///< what its values are, one clause
    /// Values of the most absurd scenes: below the scene's own, and above. One of them at least.
    std::optional<double> low{};
    std::optional<double> high{};
    bool down_to_zero = false; ///< beyond `low`, zero itself
    bool whole = false;        ///< values are whole numbers
    bool (*suits)(const Scene& scene) = nullptr;
    /// The value that the scene has, or that leaves it as it is; positive.
    double (*own)(const Scene& scene) = nullptr;
    /// Changes a suitable scene so that it has the value. Vertices are rounded to float, once.
    /// Throws Error where there is no such scene. Null where the parameter is a setting of
    /// techniques.
    void (*take)(Scene& scene, double value) = nullptr;
    /// A setting of techniques instead: its flag, without dashes, for those that heed it, and what
    /// the flag takes for a value.
    std::string_view flag{};
    double (*flag_value)(const Scene& scene, double value) = nullptr;
};

/// In the order in which they are tried.
std::span<const StressParameter> stress_parameters();

/// Null where there is none of that name.
const StressParameter* find_parameter(std::string_view name);

/// The values to try on one side of the scene's own, `up` or down, from it outwards: powers of ten,
/// about `steps` of them, the last one the end of the parameter's range, and zero where the
/// parameter goes down to it. Empty where the parameter has no such side or the scene is beyond it.
std::vector<double> ladder(const StressParameter& parameter, const Scene& scene, bool up,
                           int steps = 6);

/// A parameter's value for a scene.
struct Stress {
    std::string parameter{};
    double value = 0;
};

/// The scene at a value of one of its parameters. It may provoke any cause, because what its file
/// declares is true only of the scene as it was. Throws Error where the parameter is unknown, does
/// not suit the scene, or has no such value.
Scene stressed(Scene scene, const Stress& stress);

/// "near_plane=1e-06", as --stress takes it.
std::string words_of(const Stress& stress);

} // namespace shadowproof
