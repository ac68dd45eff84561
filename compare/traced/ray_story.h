// The story of a traced pixel: where its rays started, what they met, and what they ought to meet.
#pragma once

#include "compare/judge/account.h"
#include "compare/judge/pixel_record.h"
#include "compare/traced/ray_cause.h"

namespace shadowproof {

/// `fault`: what is wrong with the pixel's rays, if anything is.
Account account_of_rays(const TracedClaim& claim, PixelPlace p, RayFault fault, double unit);

} // namespace shadowproof
