// What becomes of a crossing when a technique counts: the ledger, line by line.
#pragma once

#include "reference/ledger.h"
#include "scenes/frame.h"

#include <cstdint>
#include <string_view>

namespace shadowproof {

enum class Tally : std::uint8_t {
    counted,
    beyond,    ///< not asked for: behind the surface (depth pass), in front of it (depth fail)
    lost_near, ///< in front of the near plane, which clips it
    lost_far,  ///< past a far plane that clips
    lost_cap,  ///< on a cap that is not drawn
};

/// "counted", "lost_near"
std::string_view name_of(Tally tally);

/// What becomes of one crossing, where triangle `seen` is the surface, at view depth `surface`. A
/// triangle's own light cap lies behind it, as its counter does not count itself. Background
/// (no_triangle) lies at `far`, the far plane of finite projections, else at infinity.
Tally tally(const Crossing& crossing, double surface, std::uint32_t seen, double far,
            const Counting& counting, const DepthModel& depth_model);

/// What becomes of the dark caps, which close at infinity the volumes that the ray has not left.
Tally tally_of_dark_caps(const Counting& counting, const DepthModel& depth_model);

/// What a counted crossing, or dark cap, adds to the counter: +1 or -1 times this.
constexpr int weight(const Counting& counting) {
    return counting.test == Counting::Test::depth_pass ? 1 : -1;
}

} // namespace shadowproof
