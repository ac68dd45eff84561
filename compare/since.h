// Changes since an earlier run, pixel by pixel: other pixels are a change even if the counts are
// equal.
#pragma once

#include "compare/gate.h"
#include "scenes/image.h"

#include <cstdint>
#include <optional>

namespace shadowproof {

/// A pixel that changed; no cause means no difference from the truth.
struct PixelChange {
    int x = 0;
    int y = 0;
    std::optional<Cause> cause; ///< now; none: gone
    std::optional<Cause> was;   ///< in the baseline; none: new
};

/// One cell against the same cell of a baseline.
struct Since {
    std::uint64_t appeared = 0; ///< pixels that differ now and did not
    std::uint64_t gone = 0;     ///< pixels that differed and do not now
    std::uint64_t changed = 0;  ///< pixels that still differ, but of another cause
    CausePixels causes{};       ///< those new or changed, by their cause now
    /// The first of each in rows from the top; one that involves more than `edge` is preferred.
    std::optional<PixelChange> first_new;
    std::optional<PixelChange> first_gone;
    std::optional<PixelChange> first_changed;
};

/// The one change to name first: new or changed and not edge, else new, changed, gone.
std::optional<PixelChange> first_of(const Since& since);

/// Both as Comparison::cause, of one size (asserted).
Since changes_since(const Image<std::uint8_t>& was, const Image<std::uint8_t>& now);

/// "3 new, 1 gone, 2 of another cause; new from (3,4) near_plane; ..."; "unchanged" where nothing
/// is.
std::string words_of(const Since& since);

} // namespace shadowproof
