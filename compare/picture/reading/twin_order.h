// Whether twins are darker and brighter than their picture, as they must be: light takes nothing
// away, and shadows add nothing.
#pragma once

#include "reference/trace/trace.h"
#include "scenes/load/picture/picture.h"

namespace shadowproof {

/// In which share of the surfaces that `truth` sees a picture that should be the darker one is the
/// brighter one. Pictures of its size are compared by small squares: noise has the difference
/// either way, so that its median in a square is near none. `step` as step_of has it; fewest_steps
/// of it are no difference.
double share_in_wrong_order(const GroundTruth& truth, const Picture& darker,
                            const Picture& brighter, double step);

/// Which share may be in the wrong order: highlights and noise have some of it so.
inline constexpr double most_in_wrong_order = 0.05;

} // namespace shadowproof
