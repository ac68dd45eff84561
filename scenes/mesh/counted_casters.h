// The casters as a stencil technique extrudes them: holes filled, some triangles flipped, some
// casters left out. The judge computes them independently, from the same definitions:
// reference/trace/shells.h, reference/predict/volumes.h.
#pragma once

#include "scenes/frame.h"
#include "scenes/scene.h"

#include <cstdint>
#include <vector>

namespace shadowproof {

/// One flag per triangle: set for each closed shell of casters, wound outwards, that contains the
/// chosen light. Perhaps none of its triangles faces the light, and yet the shell shadows
/// everything outside it; flipped, its triangles give it that volume. Empty where there is no such
/// shell. A shell is a set of triangles connected by shared edges.
std::vector<std::uint8_t> triangles_around_light(const Scene& scene);

/// The same flags and, in all shells that are not both closed and wound outwards, those of the
/// triangles that face away from the light. Each triangle of such a shell then casts a shadow by
/// itself, as in the ground truth. So every shadow of any polygon soup is cast, except where a
/// closed shell crosses itself.
std::vector<std::uint8_t> triangles_to_flip(const Scene& scene);

/// The scene with open casters closed (where `counting` fills holes), the triangles flagged by
/// `flipped` flipped (empty: none), and left-out casters no longer casting. A flipped triangle has
/// its first two corners exchanged. Its set-up in a rasterizer stays the same, since rasterizers
/// make the same exchange for clockwise triangles.
Scene counted_casters(const Scene& scene, const Counting& counting,
                      const std::vector<std::uint8_t>& flipped);

} // namespace shadowproof
