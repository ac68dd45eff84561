// The claim as a stencil, for lighting by bump maps where shadows were found in another way.
#pragma once

#include "raster/gl/shader.h"
#include "raster/gl/target.h"

namespace shadowproof {

/// Draws what the claim does not show as lit.
Program link_not_lit(const GlFunctions& gl);

/// Sets the stencil to 1 where the claim does not show light, and to 0 elsewhere. The target must
/// have a colour (add_color). Leaves its framebuffer bound, and writes no colour.
void keep_claim_in_stencil(const GlFunctions& gl, const Program& not_lit, const Target& target);

} // namespace shadowproof
