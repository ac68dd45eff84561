// How near a technique's numbers are to failing: computed from the truth and the arithmetic of a
// driver, never from what was drawn.
#pragma once

#include "compare/stencil/pixel_cause.h"

namespace shadowproof {

/// The number of pixels at which rounding is expected to put two faces in the wrong order, over
/// log 2: from 1 on it is more likely than not that there is one, if they are taken for
/// independent. Infinite where the technique's algorithm, with exact numbers, does not show the
/// truth. Pixels whose truth changes within the driver's lateral error do not count: there either
/// answer is right.
///
/// How far off depths are is reckoned by standard deviation (compare/judge/normal_distribution.h).
/// Those of window depth and of the transform are independent: their squares add up. How the planes
/// of faces are set up is not part of it: that depends on single faces.
double strain(const CountedClaim& judged);

} // namespace shadowproof
