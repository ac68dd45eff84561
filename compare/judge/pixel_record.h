// The truth at one pixel: its eye ray, the surface that the ray meets, and the shadow volumes along
// it. Independent of any technique; for `explain` and the viewer.
#pragma once

#include "reference/predict/pixel_ledger.h"
#include "reference/predict/traced_scene.h"

#include <optional>
#include <string_view>

namespace shadowproof {

struct PixelRecord {
    int x = 0;
    int y = 0;
    glm::dvec3 start{0, 0, 0};     ///< of the eye ray
    glm::dvec3 direction{0, 0, 0}; ///< its parameter is view depth
    Visibility visibility = Visibility::background;
    Exactness exactness = Exactness::filtered;
    std::uint32_t seen = no_triangle;
    double depth = 0;                     ///< where it is seen; infinite where nothing is
    bool faces_light = false;             ///< the seen side faces the light
    bool in_cone = true;                  ///< false outside a spot light's cone
    std::uint32_t occluder = no_triangle; ///< if shadowed by a triangle: one in between
    double far = 0;                       ///< the finite far plane's depth
    std::int32_t let_through = 0;         ///< of the volumes at the surface, by holes in masks
    PixelLedger ledger;
    /// Distance in view depth from the surface to the nearest crossing other than its own light
    /// cap; none if either is missing.
    std::optional<double> depth_margin;
    /// Distance to the nearest pixel of another visibility class, between centres, in pixels; none
    /// if all pixels are of one class.
    std::optional<double> pixel_margin;
};

/// (x, y) must lie in the picture.
PixelRecord record_pixel(const TracedScene& traced, int x, int y);

/// The record with all lengths multiplied by `unit` (Scene::unit), which must be a power of two.
PixelRecord in_units(PixelRecord record, double unit);

std::string_view name_of(Exactness exactness); ///< "filtered"

} // namespace shadowproof
