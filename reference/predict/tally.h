// How a technique counts a crossing: the ledger, line by line.
#pragma once

#include "reference/predict/ledger.h"
#include "scenes/frame.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace shadowproof {

enum class Tally : std::uint8_t {
    counted,
    beyond,    ///< outside the test: behind the surface (depth pass), in front of it (depth fail)
    lost_near, ///< in front of the near plane, which clips it
    lost_far,  ///< past a far plane that clips
    lost_cap,  ///< on a cap that is not drawn
};

/// "counted", "lost_near"
std::string_view name_of(Tally tally);

/// How one crossing is counted, where triangle `seen` is the surface, at view depth `surface`. A
/// triangle's own light cap is behind it, as its counter does not count itself. Background
/// (no_triangle) lies at `far`, the far plane, or at infinity (DepthModel::background_at_far).
Tally tally(const Crossing& crossing, double surface, std::uint32_t seen, double far,
            const Counting& counting, const DepthModel& depth_model);

/// How the dark caps are counted that close, at infinity, the volumes that the ray has not left.
Tally tally_of_dark_caps(const Counting& counting, const DepthModel& depth_model);

/// What a counted crossing of a caster's volume adds to the counter: its change times this.
constexpr int weight(Counting::Test test) {
    return test == Counting::Test::depth_pass ? 1 : -1;
}
inline int weight(const Counting& counting, const Crossing& crossing) {
    return weight(counting.caster(crossing.triangle).test);
}

/// How many dark caps at infinity are met by a ray that begins in `at_eye` volumes: those of the
/// casters whose faces are counted behind the surface. The volumes of the others do not contain the
/// eye.
std::int64_t dark_caps_at_infinity(const Counting& counting, std::int32_t at_eye,
                                   std::span<const Crossing> crossings);

} // namespace shadowproof
