// Building blocks of the stages: colours, a floor, a camera that looks along it.
#pragma once

#include "scenes/bundled/author/gltf_writer.h"

#include <string>
#include <vector>

namespace shadowproof::author {

// Positions and angles are irregular on purpose: no edge, ray or face lies on a grid line of
// another. Where a stage needs a sign to be exactly zero, its numbers are multiples of 1/64 and
// nothing is rotated, so that float, double and exact arithmetic all give zero.

inline constexpr glm::dvec3 sand{0.72, 0.66, 0.55};
inline constexpr glm::dvec3 coral{0.85, 0.29, 0.20};
inline constexpr glm::dvec3 teal{0.10, 0.46, 0.48};
inline constexpr glm::dvec3 amber{0.90, 0.60, 0.13};
inline constexpr glm::dvec3 slate{0.28, 0.32, 0.40};

/// A round slab whose top is at height 0.
Placed floor(double radius);

/// The eye looks along a small floor under a high light: every ray leaves the shadow volumes before
/// the far plane, and none stays in one to infinity.
Stage looking_along_floor(std::string name, std::string title,
                          std::vector<std::string> provokes = {});

/// The same for bump-mapped things: the light comes from the left, so that the eye sees half of
/// what it lights, and the floor has no highlights.
Stage lit_from_the_left(std::string name, std::string title);

void add(Stage& stage, std::vector<Placed> things);

/// A round rod from one point to another.
Placed rod(std::string name, const glm::dvec3& from, const glm::dvec3& to, double radius,
           const glm::dvec3& color);

/// The point at the given height on the line from a light to a point of the floor.
glm::dvec3 above(const glm::dvec3& floor_point, double height, const glm::dvec3& light);

// Each in the order of the catalog.
std::vector<Stage> stages_of_planes();  ///< the near plane, the far plane and the eye
std::vector<Stage> stages_of_lights();  ///< where the light stands, and how many there are
std::vector<Stage> stages_of_casters(); ///< how many, how closed and how wound
std::vector<Stage> stages_of_bumps();   ///< lighting by bump maps
std::vector<Stage> stages_of_glare(); ///< lights under which lighting with few steps or bits fails
std::vector<Stage> stages_of_shadowed_bumps(); ///< bumps whose shadows planes or the eye spoil
std::vector<Stage> stages_of_filtered_bumps(); ///< bumps smaller than pixels
std::vector<Stage> stages_of_figures();        ///< bump-mapped models that move
std::vector<Stage> stages_of_maps();           ///< what shadow maps fail at
std::vector<Stage> stages_of_rays();           ///< what shadow rays traced in float fail at
std::vector<Stage> stages_of_masks();          ///< surfaces with holes that are no geometry

} // namespace shadowproof::author
