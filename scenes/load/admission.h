// Which scenes are admitted: those whose coordinates the arithmetic of all libraries can hold.
// Checked once, after loading, whatever the file's format.
#pragma once

#include "scenes/roundoff.h"
#include "scenes/scene.h"

namespace shadowproof {

/// The largest magnitude of a coordinate of a vertex, the eye or a light. Float computations then
/// stay finite: coordinates differ by at most 2^63, so the half area of a box, three products of
/// two differences, is at most 3 * 2^126 < 2^128 (Embree's builder, which aborts on what is not
/// finite, and adds and halves bounds as well), as is the square of a distance (lighting). Exact
/// arithmetic takes any finite double (reference/exact/exact.h).
inline constexpr double largest_coordinate = 0x1p62;

/// The largest distance of a corner from the eye, as a multiple of the median distance of all
/// corners. At the median distance a step of the grid to which rasterizers snap, 1/256 of a pixel
/// in 512, is 2^-17; the judges' doubles are off by 2^-53 of the largest number. Further out they
/// could not tell one pixel from the next.
inline constexpr double largest_spread = 0x1p36;

/// The smallest distance of a corner from the eye, unless it is at the eye, as a share of the
/// median distance of all corners. In a scene of ordinary size floats hold the squares of such
/// distances: those above 2^-126. Where they do not, what lighting makes of it vanishes.
inline constexpr double smallest_share = 0x1p-62;

/// The smallest component, except 0, of the eye, a light's position or its direction. Doubles hold
/// products of three such.
inline constexpr double smallest_number = 0x1p-340;

/// The smallest half of a picture's width or height at depth 1. Each view coordinate of a point is
/// a sum of three products in floats, and off by up to five roundings of the point's distance. In a
/// narrower picture, floats cannot place any point.
inline constexpr double smallest_half_extent = 5 * float_roundoff;

/// Largest colour, intensity and scale of bumps.
inline constexpr double largest_lighting_number = 0x1p30;

/// Scenes whose size is between the reciprocal of this and this are left as they are. The size is
/// the median, over the vertices, of the largest coordinate, so that one stray vertex does not
/// decide. Details of a small scene are 2^-24 of its size, where its floats end: squares of these
/// are above 2^-126, the smallest that GPUs are sure to hold, down to 2^-39. The same bound upwards
/// leaves factors of 2^23 for lights and vertices far out.
inline constexpr double ordinary_size = 0x1p39;

/// Multiplies a scene that is not of ordinary size, including camera, lights and Scene::unit, by a
/// power of two that makes it so, where that is exact for every number; else leaves it alone.
void bring_to_ordinary_size(Scene& scene);

/// The same scene with all lengths in the file's units.
Scene in_file_units(Scene scene);

/// bring_to_ordinary_size; then throws Error, naming mesh and vertex, camera or light, where
/// something is not finite or beyond what arithmetic can hold.
void admit(Scene& scene);

} // namespace shadowproof
