// The casters as a technique makes volumes of them: filled up, turned round, left out.
#pragma once

#include "scenes/frame.h"
#include "scenes/scene.h"
#include "scenes/topology.h"

#include <cstdint>
#include <span>
#include <vector>

namespace shadowproof {

/// A flag a triangle: of a closed caster, wound outwards, that has the chosen light inside. None of
/// its triangles need face the light, and yet it darkens all the world around: turned round, its
/// volumes say so. Empty where there are none. `casters`: inspect_casters.
std::vector<std::uint8_t> triangles_around_light(const Scene& scene,
                                                 std::span<const CasterReport> casters);

/// A flag a triangle: it casts, and is averted from the chosen light. With all these turned round,
/// every triangle throws a shadow by itself, as the truth has it: right on any polygon soup. Where
/// `around_light` are enough, it is those: every connected shell is closed and wound outwards, and
/// the light is in none of which they are not all.
std::vector<std::uint8_t>
triangles_averted_from_light(const Scene& scene, const std::vector<std::uint8_t>& around_light);

/// The scene with open casters closed, flagged triangles turned round, and casters that are left
/// out no longer casting. A turned triangle has its first two corners exchanged, which leaves its
/// set-up in a rasterizer as it was: one that is wound clockwise is exchanged so there.
Scene counted_casters(const Scene& scene, const Counting& counting);

bool leaves_casters_out(const Counting& counting);

} // namespace shadowproof
