// The perspective camera, and THE definition of which ray belongs to which pixel: the reference
// traces these rays, and the rasterizer's matrices follow from the same numbers.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace shadowproof {

/// The largest number of pixels along a side: a float's 24 bits and every OpenGL 4.5 framebuffer
/// hold it.
inline constexpr int largest_side = 16384;

/// World units are the scene's own; depth is measured along `forward`.
struct Camera {
    glm::dvec3 eye{0, 0, 0};
    glm::dvec3 right{1, 0, 0}; ///< right, up, forward: orthonormal, right x up = -forward
    glm::dvec3 up{0, 1, 0};
    glm::dvec3 forward{0, 0, -1}; ///< the view direction
    double tan_half_height = 1;   ///< tan(yfov / 2); the width follows from the aspect ratio
    double near = 0.1;            ///< depth of the near plane, > 0
    double far = std::numeric_limits<double>::infinity(); ///< depth of the far plane
    int width = 512;                                      ///< pixels
    int height = 512;                                     ///< pixels
};

/// Half extents of the picture at depth 1: (tan_half_height * width / height, tan_half_height).
glm::dvec2 half_extent(const Camera& camera);

/// Direction D of the ray through picture point (x, y), in pixels from the top left corner, so that
/// eye + t * D has view depth t. Its three doubles, as rounded here, ARE the ray: the reference
/// takes them as exact.
glm::dvec3 ray_direction(const Camera& camera, double x, double y);

/// The two parts of a ray's direction: ray_direction(x, y) is ray_column(x) + ray_row(y), bit for
/// bit.
glm::dvec3 ray_column(const Camera& camera, double x);
glm::dvec3 ray_row(const Camera& camera, double y);

/// Ray directions through the corners of a rectangle of the picture, clockwise from the top left.
std::array<glm::dvec3, 4> corner_rays(const Camera& camera, double left, double top, double right,
                                      double bottom);

/// View depth of a world point: dot(point - eye, forward).
double view_depth(const Camera& camera, const glm::dvec3& point);

/// Picture point, in pixels from the top left corner, of a world point in front of the eye
/// (view depth > 0).
glm::dvec2 project(const Camera& camera, const glm::dvec3& point);

/// Eye-relative world vectors to OpenGL view space (looking down -z): the rows are right, up and
/// -forward. No translation: subtract the eye first.
glm::dmat3 view_from_eye_relative(const Camera& camera);
glm::dmat4 view_from_world(const Camera& camera);

/// OpenGL projections; window depth grows away from the eye except in the last.
glm::dmat4 clip_from_view_finite(const Camera& camera, double far); ///< z in [-w, w]
glm::dmat4 clip_from_view_infinite(const Camera& camera);           ///< z in [-w, w]
glm::dmat4 clip_from_view_infinite_reversed(const Camera& camera);  ///< z in [0, w], 1 at near
glm::dmat4 clip_from_view_finite_reversed(const Camera& camera, double far); ///< the same, 0 at far

} // namespace shadowproof
