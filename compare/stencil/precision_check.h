// Whether a pixel's `precision` is a matter of the technique's numbers at all: nearer than the
// depth at which these stop being precise enough, it is not.
#pragma once

#include "compare/stencil/pixel_cause.h"

namespace shadowproof {

/// Whether a pixel, whose cause is `precision` by depths of faces that are rounded, lies where the
/// numbers suffice. Rounding may displace a shadow's border there, but by one pixel at most: so
/// within a pixel some ray must have what was read back with all depths exact, or the plane of a
/// face of a volume must meet that of the surface shown, or a clipping plane. Where two meet at so
/// small an angle, or are so thin, that rounding may displace their line by more, no depth
/// suffices.
bool is_too_near(const CountedClaim& judged, PixelPlace p);

} // namespace shadowproof
