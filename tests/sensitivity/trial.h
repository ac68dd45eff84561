// Faults tried on one bundled scene, technique by technique.
#pragma once

#include "compare/verdict.h"
#include "raster/gl/context.h"
#include "raster/technique.h"
#include "tests/compare/traced_scene.h"
#include "tests/sensitivity/effect.h"
#include "tests/sensitivity/faults.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace shadowproof {

constexpr int tried_width = 200; ///< of the pictures
constexpr int tried_height = 200;

/// A cell, and what a fault did there.
struct TriedCell {
    std::string place{};   ///< "many_lights-fill/zpass"
    std::string verdict{}; ///< or "refused"
    std::string effect{};
};

/// What has become of a fault so far.
struct Outcome {
    std::optional<TriedCell> caught;
    std::optional<TriedCell> escaped; ///< where it changed most without being caught
    std::uint64_t escaped_size = 0;
};

/// The bundled scene of a name, as a picture of a size that is quickly judged.
Scene load_to_try(const std::string& name);

/// Those of the bundled names that are of the chosen scenes; of none: all.
std::vector<std::string> scene_names(const std::vector<std::string>& chosen);

/// Whether a fault is to be tried with a technique on a scene of this name.
bool concerns(const faults::Fault& fault, const Technique& technique, const Scene& scene);

class Trial {
public:
    Trial(Scene scene, Gpu& gpu) : traced_(std::move(scene)), gpu_(gpu) {}

    const Scene& scene() const { return traced_.scene; }

    /// Switches a fault of the catalogue on. `amount`: of faults that have one.
    void run(int number, const Technique& technique, Outcome& outcome, double amount = 0);

private:
    tests::TracedScene traced_;
    Gpu& gpu_;
    std::map<std::string_view, Frame> right_;

    std::pair<Verdict, Effect> tried(int number, const Technique& technique, double amount);
    const Frame& right(const Technique& technique);
};

} // namespace shadowproof
