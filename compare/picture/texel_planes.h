// Shadow maps in one plane, of a spot or a directional light: how their texels lie, read off the
// steps of a picture's shadows. Neither file nor picture says which way up such a map is, where it
// begins, and how large its texels are.
#pragma once

#include "compare/picture/light_sampling.h"
#include "compare/picture/shadow_steps.h"

#include <vector>

namespace shadowproof {

/// With the texels moved by some of their sides along an axis.
TexelPlane moved(TexelPlane plane, int axis, double texels);

/// With wider texels, or narrower ones, so that those at a place stay where they are, and those so
/// far away from it move by some of their sides.
TexelPlane widened(TexelPlane plane, const glm::dvec2& held, double away, double texels);

/// A square that a map may have.
struct MapSquare {
    LightAxes axes;
    double side = 0;               ///< in the units of place_from_light
    std::optional<glm::dvec2> low; ///< where it begins, as of place_from_light; nothing: anywhere
    bool is_measured = false;      ///< read off the picture, and so not exact
};

/// For a spot, what just holds its cone. For a directional light: what this program's own sun map
/// takes, which just holds the scene; and ten units, which a DirectionalLight of three.js takes
/// where nothing is said.
std::vector<MapSquare> usual_squares(const Scene& scene);
/// Of which two opposite ends were found; of a directional light one, if its middle is where the
/// file has the light, or the world's origin: as it was measured, and if it then has a side of two
/// digits, with that.
std::vector<MapSquare> measured_squares(const LightFrustum& frustum, const Light& light);

/// A square of so many texels a side; `steps`: of its axes. Where it may lie anywhere, so that
/// their borders explain best where shadows begin and end.
TexelPlane divided(const ShadowSteps& steps, const MapSquare& square, int across);

/// Texels whose borders explain the places at which the picture's shadows begin and end, the best
/// first, wherever they begin; then those that lie evenly around the usual middles of such a
/// light's map. Their corners and sides are as good as that tells them.
std::vector<TexelPlane> proposed_planes(const ShadowSteps& steps, const Light& light);

} // namespace shadowproof
