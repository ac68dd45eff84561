// Stencil techniques with one fault each, built from the parts of the right ones. They declare the
// same counting and depth model as the right ones, so a ledger must catch them.
#pragma once

#include "raster/gl/context.h"
#include "raster/technique.h"

#include <span>

namespace shadowproof::tests {

/// zfail_reversed whose volumes are open at infinity. Shows where a volume is seen that far.
Frame without_dark_cap(Gpu& gpu, const Scene& scene, const Plan& plan);

/// zfail_clamp that counts down where it should count up. The counter is negated, and zero stays
/// zero: the claim is right all the same, only the counter tells.
Frame with_swapped_steps(Gpu& gpu, const Scene& scene, const Plan& plan);

/// zfail_clamp that lacks the side of the longest silhouette edge.
Frame without_one_side(Gpu& gpu, const Scene& scene, const Plan& plan);

/// zpass drawn with a near plane twice as far away. Shows where that lies elsewhere among surfaces
/// or volumes.
Frame with_wrong_near_plane(Gpu& gpu, const Scene& scene, const Plan& plan);

/// zfail_reversed with the light mirrored in x about the middle of the scene.
Frame with_mirrored_light(Gpu& gpu, const Scene& scene, const Plan& plan);

/// zpass that takes every light cap for hidden by its own surface. Shows where one of which the
/// surface is culled lies in front of what is seen.
Frame with_all_caps_hidden(Gpu& gpu, const Scene& scene, const Plan& plan);

/// The six, named as the functions, each known for what its right twin is known for.
std::span<const Technique> faulty_techniques();

} // namespace shadowproof::tests
