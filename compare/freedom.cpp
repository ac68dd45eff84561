#include "compare/freedom.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <optional>

namespace shadowproof {

namespace {

constexpr double v = 0x1p-24; ///< rounding unit of float

/// Sum of the sizes of the terms that the float transform adds up for one view coordinate of a
/// point, the largest over the three. World coordinates carry the eye's distance from the origin
/// with them; eye-relative ones do not, but subtract the eye as two floats, which rounds twice. A
/// point of a volume's side was extruded from the light, and that direction is rounded too.
double transform_terms(const Scene& scene, const DepthModel& depth_model, const glm::dvec3& point) {
    const Camera& camera = scene.camera;
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    double largest = 0;
    for (const glm::dvec3& axis : {camera.right, camera.up, camera.forward}) {
        const auto terms = [&](const glm::dvec3& p) {
            return glm::dot(glm::abs(axis), glm::abs(p));
        };
        const double position = depth_model.eye_relative ? 2 * terms(point - camera.eye)
                                                         : terms(point) + terms(camera.eye);
        largest = std::max(largest, position + terms(light.w * point - glm::dvec3(light)));
    }
    return largest;
}

/// View depth of `point`, at least the near plane's.
double depth_of(const Camera& camera, const glm::dvec3& point) {
    return std::max(view_depth(camera, point), camera.near);
}

} // namespace

// A matrix entry is rounded (1), multiplied (1) and added up (3): 5 v of the terms' sizes. In x
// that moves a point by scale / depth pixels a unit, in w by its own distance from the middle, at
// most half the picture, over the depth. The division, the viewport's product and its sum each
// round a coordinate of up to the picture's width: 3 v.
double lateral_freedom(const Scene& scene, const DepthModel& depth_model, const glm::dvec3& point) {
    const Camera& camera = scene.camera;
    const double half_step = std::exp2(-depth_model.subpixel_bits - 1);
    const double pixels = std::max(camera.width, camera.height);
    const double scale = 0.5 * camera.height / camera.tan_half_height;
    const double terms = transform_terms(scene, depth_model, point);
    const double transform = 5 * v * (scale + 0.5 * pixels) * terms / depth_of(camera, point);
    return half_step + transform + 3 * v * pixels;
}

// Window depth z is rounded at 1/w, z/w, the viewport's sum (its product is by a power of two), and
// at the pixel in two products and two sums of its plane: 7 times by at most v z, where z = 1 is
// the largest standard depth and z = n/t the reversed one (where that is finite, a difference of
// terms whose sizes times dt/dz make t all the same). Storing it in fixed point rounds once
// more, by half a step: v / 2. In all less than 8 v z for a face, so `depth_roundings` for two that
// are compared, carried back to view depth by dt/dz. The transform's sums round 5 times a face (see
// lateral_freedom), which 8 covers too. (The plane's slope is computed from its
// corners: its error is one of place, far below the snapping step, and covered with that.)
double depth_freedom(const Scene& scene, const DepthModel& depth_model, const glm::dvec3& point) {
    const double t = depth_of(scene.camera, point);
    const double near = depth_model.near;
    const double far = depth_model.far;
    double window_depth_error = t * t / near; // dt/dz times z, projection infinite
    if (depth_model.finite()) window_depth_error = t * t * (far - near) / (far * near);
    if (depth_model.reversed()) window_depth_error = t;
    return depth_roundings * (window_depth_error + transform_terms(scene, depth_model, point));
}

namespace {

/// A point of the picture, in pixels, and the inverse of its view depth, which is linear there as
/// window depth is.
struct PicturePoint {
    glm::dvec2 place{0, 0};
    double inverse_depth = 0;
};

/// A line along which one end of an edge is extruded, as far as the picture shows it.
using PictureLine = std::array<PicturePoint, 2>;

PicturePoint between(const PicturePoint& from, const PicturePoint& to, double way) {
    return {from.place + way * (to.place - from.place),
            from.inverse_depth + way * (to.inverse_depth - from.inverse_depth)};
}

/// A homogeneous point (p, w) relative to the eye along right, up and forward, and its w.
glm::dvec4 viewed(const Camera& camera, const glm::dvec4& point) {
    const glm::dvec3 relative = glm::dvec3(point) - point.w * camera.eye;
    return {glm::dot(camera.right, relative), glm::dot(camera.up, relative),
            glm::dot(camera.forward, relative), point.w};
}

PicturePoint pictured(const Camera& camera, const glm::dvec4& view) {
    const glm::dvec2 half = half_extent(camera);
    return {{(view.x / view.z / half.x + 1) * 0.5 * camera.width,
             (1 - view.y / view.z / half.y) * 0.5 * camera.height},
            view.w / view.z};
}

/// The part of a line that lies in the picture; where none does, the point of it nearest to
/// `pixel`, twice.
PictureLine in_picture(const Camera& camera, const PictureLine& line, const glm::dvec2& pixel) {
    const glm::dvec2 along = line[1].place - line[0].place;
    double from = 0;
    double to = 1;
    const std::array<double, 2> size{static_cast<double>(camera.width),
                                     static_cast<double>(camera.height)};
    for (int axis = 0; axis < 2; ++axis) {
        const double start = line[0].place[axis];
        if (along[axis] == 0) {
            if (start < 0 || start > size[static_cast<std::size_t>(axis)]) to = -1;
            continue;
        }
        const double one = -start / along[axis];
        const double other = (size[static_cast<std::size_t>(axis)] - start) / along[axis];
        from = std::max(from, std::min(one, other));
        to = std::min(to, std::max(one, other));
    }
    if (from <= to) return {between(line[0], line[1], from), between(line[0], line[1], to)};
    const double squared = glm::dot(along, along);
    const double nearest =
        squared > 0 ? std::clamp(glm::dot(pixel - line[0].place, along) / squared, 0.0, 1.0) : 0;
    const PicturePoint point = between(line[0], line[1], nearest);
    return {point, point};
}

/// The line from a homogeneous point to another in front of the near plane, if any of it is.
std::optional<PictureLine> line_between(const Camera& camera, const glm::dvec4& start,
                                        const glm::dvec4& end, const glm::dvec2& pixel) {
    glm::dvec4 from = viewed(camera, start);
    glm::dvec4 to = viewed(camera, end);
    const auto beyond_near = [&](const glm::dvec4& p) { return p.z - camera.near * p.w; };
    const double one = beyond_near(from);
    const double other = beyond_near(to);
    if (one <= 0 && other <= 0) return std::nullopt;
    const auto at_near = [&] { return from + one / (one - other) * (to - from); };
    if (one < 0)
        from = at_near();
    else if (other < 0)
        to = at_near();
    if (from.z <= 0 || to.z <= 0) return std::nullopt;
    return in_picture(camera, {pictured(camera, from), pictured(camera, to)}, pixel);
}

double distance_to_line(const glm::dvec2& point, const PictureLine& line) {
    const glm::dvec2 along = line[1].place - line[0].place;
    const glm::dvec2 to_point = point - line[0].place;
    const double length = glm::length(along);
    if (length == 0) return glm::length(to_point);
    return std::abs(along.x * to_point.y - along.y * to_point.x) / length;
}

} // namespace

// A rasterizer makes a triangle's depth a plane over the picture: with differences x01, y01, z01 of
// its first two corners and x20, y20, z20 of the third and first, A = x01 y20 - x20 y01, and
//   dz/dx = (z01 y20 - y01 z20) / A,   dz/dy = (z20 x01 - x20 z01) / A,
// and follows it from the first corner on by (lx, ly). Let no corner be further than l from
// another, and |A| at least l times the width s. Differences, products and the quotient round: 5 v
// for each of the four terms z01 y20 lx / A and so on, of which two and two are at most z l^2 / A
// together
// (|sin cos| < 1/2), z being the range of depths: 10 v z l / s. In A, 3 v of each product, again at
// most l^2 together: 3 v l^2 / A of what was climbed, at most z: 3 v z l / s. Clipping to the
// picture cuts a side into triangles as long as its part in the picture and as wide as one of its
// ends. Sides of fine meshes are long and thin: a corner far away then puts the near end off by far
// more than its own rounding.
double thinness_freedom(const Scene& casters, const std::vector<glm::vec3>* far_ends,
                        const Crossing& side, const glm::dvec3& direction) {
    const Camera& camera = casters.camera;
    const glm::dvec4 light = homogeneous(chosen_light(casters));
    const glm::dvec2 pixel = project(camera, camera.eye + direction);
    const auto line_of = [&](int corner) {
        const std::uint32_t index = casters.triangles[side.triangle][corner];
        const glm::dvec3 start = casters.positions[index];
        const glm::dvec4 end = far_ends != nullptr
                                   ? glm::dvec4(glm::dvec3((*far_ends)[index]), 1)
                                   : glm::dvec4(light.w * start - glm::dvec3(light), 0);
        return line_between(camera, glm::dvec4(start, 1), end, pixel);
    };
    const int first = static_cast<int>(side.part);
    const std::optional<PictureLine> one = line_of(first);
    const std::optional<PictureLine> other = line_of((first + 1) % 3);
    if (!one || !other) return 0;
    double width = std::numeric_limits<double>::infinity();
    double length = 0;
    double low = (*one)[0].inverse_depth;
    double high = low;
    for (const PictureLine* line : {&*one, &*other})
        for (const PicturePoint& point : *line) {
            width = std::min(width, distance_to_line(point.place, line == &*one ? *other : *one));
            low = std::min(low, point.inverse_depth);
            high = std::max(high, point.inverse_depth);
            for (const PictureLine* each : {&*one, &*other})
                for (const PicturePoint& far : *each)
                    length = std::max(length, glm::distance(point.place, far.place));
        }
    if (length == 0) return 0;
    return 13 * v * (length / width) * (high - low);
}

} // namespace shadowproof
