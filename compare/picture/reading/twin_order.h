// Whether twins are darker and brighter than their picture, as they must be: light takes nothing
// away, and shadows add nothing.
#pragma once

#include "scenes/load/picture/picture.h"

namespace shadowproof {

/// In which share of the view a picture that should be the darker one is the brighter one. Two
/// pictures of one size are compared by small squares: noise has the difference either way, so that
/// its median in a square is near none. `step` as step_of has it; fewest_steps of it are no
/// difference.
double share_in_wrong_order(const Picture& darker, const Picture& brighter, double step);

/// Which share of a view may be in the wrong order: highlights and noise have some of it so.
inline constexpr double most_in_wrong_order = 0.05;

} // namespace shadowproof
