// The camera, and THE definition of which line of sight belongs to which pixel: the reference
// traces these lines, and the rasterizer's matrices follow from the same numbers.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>

namespace shadowproof {

/// The largest number of pixels along a side: a float's 24 bits and every OpenGL 4.5 framebuffer
/// hold it.
inline constexpr int largest_side = 16384;

/// Whether lines of sight meet in the eye, or are all parallel.
enum class Projection : std::uint8_t { perspective, orthographic };

/// World units are the scene's own; depth is measured along `forward`, from the eye or, of an
/// orthographic camera, from the plane through it.
struct Camera {
    Projection projection = Projection::perspective;
    glm::dvec3 eye{0, 0, 0};
    glm::dvec3 right{1, 0, 0}; ///< right, up, forward: orthonormal, right x up = -forward
    glm::dvec3 up{0, 1, 0};
    glm::dvec3 forward{0, 0, -1}; ///< the view direction
    double half_height = 1; ///< half the picture's: at depth 1, tan(yfov / 2), or, in world units,
                            ///< at every depth where it is orthographic; its width is to its height
                            ///< as the pixels are
    double near = 0.1;      ///< depth of the near plane: > 0, or >= 0 where it is orthographic
    double far = std::numeric_limits<double>::infinity(); ///< depth of the far plane
    int width = 512;                                      ///< pixels
    int height = 512;                                     ///< pixels

    bool is_orthographic() const { return projection == Projection::orthographic; }
};

/// The eye in homogeneous coordinates: (its place, 1), or (the direction to it, 0) where the camera
/// is orthographic. What a point sees of a triangle, and where an edge lies before it, follows from
/// these as it does of a light.
glm::dvec4 homogeneous_eye(const Camera& camera);

/// Half extents of the picture, as half_height is.
glm::dvec2 half_extent(const Camera& camera);

/// The line of sight through picture point (x, y), in pixels from the top left corner, as one
/// vector: the direction D, so that eye + t D has view depth t; or, of an orthographic camera, the
/// start S in the plane through the eye, so that S + t forward has. Its three doubles, as rounded
/// here, ARE the line: the reference takes them as exact.
glm::dvec3 line_of_sight(const Camera& camera, double x, double y);

/// The two parts of it: line_of_sight(x, y) is sight_column(x) + sight_row(y), bit for bit.
glm::dvec3 sight_column(const Camera& camera, double x);
glm::dvec3 sight_row(const Camera& camera, double y);

/// Where a line of sight starts, and its direction.
inline const glm::dvec3& start_of(const Camera& camera, const glm::dvec3& line) {
    return camera.is_orthographic() ? line : camera.eye;
}
inline const glm::dvec3& direction_of(const Camera& camera, const glm::dvec3& line) {
    return camera.is_orthographic() ? camera.forward : line;
}
/// Its point at a view depth.
inline glm::dvec3 point_on(const Camera& camera, const glm::dvec3& line, double depth) {
    return start_of(camera, line) + depth * direction_of(camera, line);
}

/// The line of sight that starts at the eye and runs along `forward`.
inline const glm::dvec3& eye_line(const Camera& camera) {
    return camera.is_orthographic() ? camera.eye : camera.forward;
}

/// The lines of sight through the corners of a rectangle of the picture, clockwise from the top
/// left.
std::array<glm::dvec3, 4> corner_lines(const Camera& camera, double left, double top, double right,
                                       double bottom);

/// Unit, from a point to the eye.
glm::dvec3 way_to_eye(const Camera& camera, const glm::dvec3& point);

/// View depth of a world point: dot(point - eye, forward).
double view_depth(const Camera& camera, const glm::dvec3& point);

/// Picture point, in pixels from the top left corner, of a world point in front of the eye
/// (view depth > 0, or any where the camera is orthographic).
glm::dvec2 project(const Camera& camera, const glm::dvec3& point);

/// Picture point, likewise, of a line of sight: the inverse of line_of_sight.
inline glm::dvec2 place_of(const Camera& camera, const glm::dvec3& line) {
    return project(camera, point_on(camera, line, 1));
}

/// How many pixels a length across the view covers at a view depth.
double pixels_of_length(const Camera& camera, double depth);

/// Eye-relative world vectors to OpenGL view space (looking down -z): the rows are right, up and
/// -forward. No translation: subtract the eye first.
glm::dmat3 view_from_eye_relative(const Camera& camera);
glm::dmat4 view_from_world(const Camera& camera);

/// OpenGL projections; window depth grows away from the eye except in the last two. Infinite ones
/// are a perspective camera's alone: parallel lines of sight have no such form.
glm::dmat4 clip_from_view_finite(const Camera& camera, double far); ///< z in [-w, w]
glm::dmat4 clip_from_view_infinite(const Camera& camera);           ///< z in [-w, w]
glm::dmat4 clip_from_view_infinite_reversed(const Camera& camera);  ///< z in [0, w], 1 at near
glm::dmat4 clip_from_view_finite_reversed(const Camera& camera, double far); ///< the same, 0 at far

} // namespace shadowproof
