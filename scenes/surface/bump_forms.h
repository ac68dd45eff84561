// The texels of a bump map in each of its forms (BumpForm), made once from the asset's. The same
// numbers go to OpenGL, whose shaders fetch texels and interpolate them bilinearly by hand.
#pragma once

#include "scenes/image.h"
#include "scenes/lighting_settings.h"
#include "scenes/scene.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace shadowproof {

/// The texels of one material, and how the perturbed normal m follows from them after
/// interpolation. m need not be normalised.
struct BumpTexels {
    BumpForm form = BumpForm::normal_map; ///< never as_given
    /// height_field: heights in red, whose slopes (relief.h) are interpolated, m = (-s, t, 1).
    /// normal_map: m = 2 rgb - 1, its x and y times `scale`.
    /// derivatives: (s, t) = slope_range (2 rg - 1), m = (-s, t, 1).
    /// indexed: a number in red, 0 to 65535; indexed_normal of each texel is interpolated.
    Image<glm::vec4> texels{};
    double slope_range = 0; ///< of derivatives
    double scale = 1; ///< of a height (texels), or of a normal's x and y; other forms contain it
    /// Of forms that hold slopes, where the asset has heights in units of space: these over texels
    /// of this side were taken for heights in texels. Slopes times it are per texel, whatever its
    /// size. Else 0.
    double texel_side = 0;
};

/// The texels of a material that has a bump map.
///
/// Heights in units of space are taken for heights in texels of the mean side (mean_texel_side): no
/// form but the asset's own tells stretched texels from others. A height field is converted to
/// other forms by its slopes at the texels, and by the normals of relief.h; a normal map to
/// derivatives by (s, t) = (-m.x, m.y) / m.z. Bytes are rounded to nearest. A normal map requested
/// as one, and anything requested as given, is left as the asset has it.
///
/// Throws Error, naming file and material, where a normal map is requested as a height field, and
/// where one that has normals along the surface or into it is requested as derivatives.
BumpTexels bump_texels(const Scene& scene, const Material& material, BumpForm form);

/// The table of normals: (u, v) = 2 / 255 (number mod 256, number div 256) - 1 is a point of the
/// octahedron |x| + |y| + |z| = 1, seen from above, with its lower half folded outwards (Meyer et
/// al. 2010); the normal has that point's direction.
glm::dvec3 indexed_normal(std::uint16_t number);

/// The number of the nearest normal on that map: u and v each rounded to bytes. Its direction is
/// within octahedral_error of the given one.
std::uint16_t number_of(const glm::dvec3& normal);

/// Rounding moves u and v by at most 1/255 each, so a point of the octahedron by at most
/// |(1, 1, 2)| / 255; no point of it is nearer to the centre than 1 / sqrt 3, so that unit vectors
/// differ by at most sqrt 3 times that: 3 sqrt 2 / 255.
inline constexpr double octahedral_error = 0.016638;

} // namespace shadowproof
