// The claims under lights that are drawn one after the other over the same surfaces.
#pragma once

#include "raster/gl/target.h"
#include "scenes/frame.h"

#include <cstddef>
#include <vector>

namespace shadowproof {

struct KeptClaims {
    Texture unlit{};            ///< what the surface pass drew
    std::vector<Texture> lit{}; ///< under each light but the last, whose claim is the target's
};
KeptClaims make_kept_claims(const GlFunctions& gl, const Target& target, std::size_t lights);

/// After the surface pass.
void keep_unlit(const GlFunctions& gl, const Target& target, const KeptClaims& kept);
/// Before the light pass of another light, where surfaces are not drawn anew.
void take_unlit(const GlFunctions& gl, const Target& target, const KeptClaims& kept);
/// After the light pass of a light, given by its number.
void keep_claim(const GlFunctions& gl, const Target& target, const KeptClaims& kept,
                std::size_t light);

/// Those of all lights but the last, rows from the top. Overwrites the target's.
std::vector<Image<Visibility>> read_claims(const GlFunctions& gl, const Target& target,
                                           const KeptClaims& kept);

} // namespace shadowproof
