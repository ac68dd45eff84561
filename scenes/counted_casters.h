// The casters as a technique makes volumes of them: filled up, turned round, left out.
#pragma once

#include "scenes/frame.h"
#include "scenes/scene.h"

#include <cstdint>
#include <vector>

namespace shadowproof {

/// A flag a triangle: of a closed shell of casters, wound outwards, that has the chosen light
/// inside. None of its triangles need face the light, and yet it darkens all the world around:
/// turned round, its volumes say so. Empty where there are none. A shell is what hangs together by
/// edges.
std::vector<std::uint8_t> triangles_around_light(const Scene& scene);

/// The same, and of all other shells but those that are closed and wound outwards the triangles
/// averted from the light: each of their triangles then throws a shadow by itself, as the truth has
/// it. So every shadow is thrown, of any polygon soup, but where a closed shell crosses itself.
std::vector<std::uint8_t> triangles_to_turn(const Scene& scene);

/// The scene with open casters closed, flagged triangles turned round, and casters that are left
/// out no longer casting. A turned triangle has its first two corners exchanged, which leaves its
/// set-up in a rasterizer as it was: one that is wound clockwise is exchanged so there.
Scene counted_casters(const Scene& scene, const Counting& counting);

bool leaves_casters_out(const Counting& counting);

} // namespace shadowproof
