// How much of the light a shadow map's claim shows at a pixel: all, none or a share of it.
#pragma once

#include "compare/judge/judge.h"

namespace shadowproof {

/// How many comparisons, of MapModel::asked, the claim says to have found light; -1 where it shows
/// background, or a share that is no such number.
int claimed_lit(const JudgedClaim& claim, PixelPlace p);

/// Whether the claim shows light at a pixel that differs, where there is none.
bool claims_light(const JudgedClaim& claim, PixelPlace p);

} // namespace shadowproof
