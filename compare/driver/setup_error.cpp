#include "compare/driver/setup_error.h"

#include "reference/trace/faces.h"
#include "scenes/driver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <numbers>

namespace shadowproof {

namespace {

constexpr double v = float_roundoff;

using PictureTriangle = std::array<PicturePoint, 3>;

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

// llvmpipe makes a triangle's depth a plane over the picture: with differences x01, y01, z01 of its
// first two corners and x20, y20, z20 of the third and first, A = x01 y20 - x20 y01, and
//   dz/dx = z01 (y20 / A) - z20 (y01 / A),   dz/dy = z20 (x01 / A) - z01 (x20 / A),
// z at the picture's corner is z0 - (dz/dx x0 + dz/dy y0), and from there on at the pixel. Rounded
// are, by v of its size each: in the slopes' terms both differences, quotient, product and
// difference of the two (5 v), 1 / A alike in all terms; in A two differences and a product (3 v of
// each of its terms), and their difference (v). An error that is alike in all terms tilts the plane
// about the first corner, by that share of its rise to the pixel; all that is made with 1 / A is
// off by the share, too. The sums at the picture's corner and at the pixel round products of slopes
// and places: three times each, and the first one's twice more.
struct Plane {
    double z01 = 0;
    double z20 = 0;
    glm::dvec2 slope{0, 0}; ///< sizes
};
double error_from(const PicturePoint& first, const PicturePoint& second, const PicturePoint& third,
                  const glm::dvec2& pixel, const Plane& plane) {
    const auto& [z01, z20, slope] = plane;
    const glm::dvec2 d01 = first.place - second.place;
    const glm::dvec2 d20 = third.place - first.place;
    const double area = std::abs(cross(d01, d20));
    const glm::dvec2 terms(std::abs(z01 * d20.y) + std::abs(z20 * d01.y),
                           std::abs(z20 * d01.x) + std::abs(z01 * d20.x));
    const glm::dvec2 way = glm::abs(pixel - first.place);
    const double climb = std::max({std::abs(z01), std::abs(z20), glm::dot(slope, way)});
    const double terms_of_area = std::abs(d01.x * d20.y) + std::abs(d20.x * d01.y);
    const double share = v * (3 * terms_of_area / area + 2);
    if (!(share < 1)) return std::numeric_limits<double>::infinity();
    return (5 * v * glm::dot(terms / area, way) + share * climb +
            v * glm::dot(slope, 5.0 * glm::abs(first.place) + 3.0 * glm::abs(pixel))) /
           (1 - share);
}

/// Of the keys' plane.
Plane plane_of_depths(const PicturePoint& first, const PicturePoint& second,
                      const PicturePoint& third) {
    const glm::dvec2 d01 = first.place - second.place;
    const glm::dvec2 d20 = third.place - first.place;
    const double z01 = first.key - second.key;
    const double z20 = third.key - first.key;
    const double area = std::abs(cross(d01, d20));
    return {z01, z20,
            glm::abs(glm::dvec2(z01 * d20.y - z20 * d01.y, z20 * d01.x - z01 * d20.x)) / area};
}

/// The steepest plane of a value over w, q r with r the inverse w, whose value q is nowhere larger
/// than 1 and differs by at most `variation` between the corners of what was clipped: by that times
/// half the sum of the differences of their weights. q0 r0 - q1 r1 = q0 (r0 - r1) + (q0 - q1) r1.
/// `steepest`: of its slopes, as others tell; its rises are no more than these allow.
Plane steepest_plane(const PicturePoint& first, const PicturePoint& second,
                     const PicturePoint& third, double variation, const glm::dvec2& steepest) {
    const glm::dvec2 d01 = glm::abs(first.place - second.place);
    const glm::dvec2 d20 = glm::abs(third.place - first.place);
    const auto rise = [&](const PicturePoint& a, const PicturePoint& b, const glm::dvec2& way) {
        const glm::dvec3 apart = glm::abs(a.weights - b.weights);
        const double share = 0.5 * (apart.x + apart.y + apart.z);
        return std::min({a.inverse_w + b.inverse_w,
                         std::abs(a.inverse_w - b.inverse_w) +
                             share * variation * std::min(a.inverse_w, b.inverse_w),
                         glm::dot(steepest, way)});
    };
    const double z01 = rise(first, second, d01);
    const double z20 = rise(third, first, d20);
    const double area = std::abs(cross(first.place - second.place, third.place - first.place));
    const glm::dvec2 slope =
        glm::dvec2(z01 * d20.y + z20 * d01.y, z20 * d01.x + z01 * d20.x) / area;
    return {z01, z20, glm::min(slope, steepest)};
}

std::array<Plane, 3> steepest_planes(const PictureTriangle& triangle, double variation,
                                     const glm::dvec2& steepest) {
    const auto& [a, b, c] = triangle;
    return {steepest_plane(a, b, c, variation, steepest),
            steepest_plane(b, c, a, variation, steepest),
            steepest_plane(c, a, b, variation, steepest)};
}

/// What is left of a triangle is one plane still: that of its broadest part bounds the slopes of
/// all.
glm::dvec2 steepest_slope(const std::vector<PictureTriangle>& fan, double variation) {
    glm::dvec2 steepest(std::numeric_limits<double>::infinity());
    for (const PictureTriangle& triangle : fan)
        for (const Plane& plane :
             steepest_planes(triangle, variation, glm::dvec2(std::numeric_limits<double>::max())))
            if (std::isfinite(plane.slope.x) && std::isfinite(plane.slope.y))
                steepest = glm::min(steepest, plane.slope);
    return steepest;
}

double twice_area(const PictureTriangle& triangle) {
    return std::abs(
        cross(triangle[1].place - triangle[0].place, triangle[2].place - triangle[0].place));
}

/// How much of a corner's value a pixel takes, at most, where it may be drawn `reach` aside.
double weight_of(const PictureTriangle& triangle, std::size_t corner, const glm::dvec2& pixel,
                 double reach) {
    const glm::dvec2 from = triangle[(corner + 1) % 3].place;
    const glm::dvec2 along = triangle[(corner + 2) % 3].place - from;
    return (std::abs(cross(along, pixel - from)) + reach * glm::length(along)) /
           twice_area(triangle);
}

/// By how much twice the area may change where corners are off by their errors and `reach` along
/// each axis: an edge's length times the move of the corner across from it, and products of two
/// moves.
double change_of_area(const PictureTriangle& triangle, double reach) {
    double change = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const PicturePoint& one = triangle[(k + 1) % 3];
        const PicturePoint& other = triangle[(k + 2) % 3];
        const auto move = [&](const PicturePoint& corner) {
            return std::numbers::sqrt2 * (corner.place_error + reach);
        };
        change +=
            move(triangle[k]) * glm::length(other.place - one.place) + move(one) * move(other);
    }
    return change;
}

/// Which corner is the first depends on the driver: any may be. Corners are off, too, each by as
/// much as it weighs at the pixel: by more than one in sum where snapping makes a triangle cover
/// what lies beside it, and by far more where that is thin. Weights are over the area that is
/// drawn; where that may vanish, nothing is known.
double error_of(const PictureTriangle& triangle, const glm::dvec2& pixel, double reach) {
    const auto& [a, b, c] = triangle;
    const double area = twice_area(triangle);
    // Seen edge-on; or an end at infinity in no direction at all, so that the area is not a number.
    if (!(area > 0)) return std::numeric_limits<double>::infinity();
    const glm::dvec2 d01 = a.place - b.place;
    const glm::dvec2 d20 = c.place - a.place;
    const double z01 = a.key - b.key;
    const double z20 = c.key - a.key;
    const double slope =
        glm::length(glm::dvec2(z01 * d20.y - z20 * d01.y, z20 * d01.x - z01 * d20.x)) / area;
    double corners = 0;
    for (std::size_t i = 0; i < 3; ++i)
        corners += weight_of(triangle, i, pixel, reach) *
                   (triangle[i].depth_error + slope * triangle[i].place_error);
    const double changed = change_of_area(triangle, 0) / area;
    if (!(changed < 1)) return std::numeric_limits<double>::infinity();
    return corners / (1 - changed) +
           std::max({error_from(a, b, c, pixel, plane_of_depths(a, b, c)),
                     error_from(b, c, a, pixel, plane_of_depths(b, c, a)),
                     error_from(c, a, b, pixel, plane_of_depths(c, a, b))});
}

/// How much a pixel takes of each corner's value, at most.
using Weights = std::array<double, 3>;

Weights weights_of(const PictureTriangle& triangle, const glm::dvec2& pixel, double reach) {
    return {weight_of(triangle, 0, pixel, reach), weight_of(triangle, 1, pixel, reach),
            weight_of(triangle, 2, pixel, reach)};
}

/// What becomes of the error of a place that clipping gives a corner.
enum class MadePlaces : std::uint8_t {
    are_errors_of_values,
    are_told_apart, ///< DrawnAttribute::aside
};

/// For a value over w whose value is nowhere larger than 1: corners are off by their quotient's
/// and product's roundings, and those of the shader that made them, 8 v in all.
///
/// A corner made by clipping gets its value as it gets its place: three roundings more. Its place
/// is rounded, too, and its value is then that of a place beside it, as in error_of. What moves
/// corners that are not clipped is the driver's snapping and transform: lateral_error.
double attribute_error_of(const PictureTriangle& triangle, const glm::dvec2& pixel,
                          double variation, const glm::dvec2& steepest, const Weights& weights,
                          MadePlaces made) {
    const auto& [a, b, c] = triangle;
    if (!(twice_area(triangle) > 0)) return std::numeric_limits<double>::infinity();
    const std::array<Plane, 3> planes = steepest_planes(triangle, variation, steepest);
    const double slope = std::min(
        {glm::length(planes[0].slope), glm::length(planes[1].slope), glm::length(planes[2].slope)});
    double clipping = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const PicturePoint& corner = triangle[i];
        const double of_place =
            made == MadePlaces::are_errors_of_values ? slope * corner.place_error : 0;
        if (corner.made_by_clipping)
            clipping += weights[i] * (3 * v * corner.inverse_w + corner.w_error + of_place);
    }
    const double largest = std::max({a.inverse_w, b.inverse_w, c.inverse_w});
    return 8 * v * largest + clipping +
           std::max({error_from(a, b, c, pixel, planes[0]), error_from(b, c, a, pixel, planes[1]),
                     error_from(c, a, b, pixel, planes[2])});
}

/// How far aside, in pixels in any direction, a corner may be drawn, or a triangle's coverage of a
/// pixel found.
double farthest_aside(const PictureTriangle& triangle, double reach) {
    double farthest = 0;
    for (const PicturePoint& corner : triangle) farthest = std::max(farthest, corner.place_error);
    return std::numbers::sqrt2 * (reach + farthest);
}

// A triangle with its corners drawn at x_k + d_k takes at x of their values the weights w_k, which
// add up to 1: it shows the place y = x - sum w_k d_k, whose weights in the triangle as it should
// be they are. They may be negative: a pixel may be covered by snapped corners, and get its values
// of others. With S the sum of their sizes, y lies within S times the farthest d of x; there a
// weight is no larger than at x, and that way times its slope, which is its edge's length over
// twice the area. So S is at most its value at x over 1 less the farthest d times the sum of the
// slopes.
Weights drawn_weights(const PictureTriangle& triangle, const glm::dvec2& pixel, double farthest) {
    const Weights at_pixel = weights_of(triangle, pixel, 0);
    const Weights when_moved = weights_of(triangle, pixel, farthest);
    double sum = 0;
    double growth = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        sum += at_pixel[k];
        growth += when_moved[k] - at_pixel[k];
    }
    if (!(growth < 1)) {
        constexpr double any = std::numeric_limits<double>::infinity();
        return {any, any, any};
    }
    Weights weights{};
    for (std::size_t k = 0; k < 3; ++k)
        weights[k] = at_pixel[k] + sum / (1 - growth) * (when_moved[k] - at_pixel[k]);
    return weights;
}

double clipping_aside(const PictureTriangle& triangle, const Weights& weights) {
    double aside = 0;
    for (std::size_t k = 0; k < 3; ++k)
        if (triangle[k].made_by_clipping) aside += weights[k] * triangle[k].place_error;
    return aside;
}

/// The error of a value q = p / r, where p is the value over w and r the inverse w, both off by up
/// to `error`: q is off by (e + |q| e) / (r - e), where |q| is 1 at most.
double error_of_quotient(double error, double w) {
    const double share = error * w; // of the inverse w
    return share < 1 ? 2 * share / (1 - share) : std::numeric_limits<double>::infinity();
}

/// The largest over the triangles that may cover the pixel, or over all if none does.
template <class ErrorOf>
double largest_error(const Camera& camera, const std::vector<PictureTriangle>& triangles,
                     const CoveredPixel& pixel, const ErrorOf& error_of) {
    const glm::dvec2 place = place_of(camera, pixel.line);
    double covering = -1;
    double any = 0;
    for (const PictureTriangle& triangle : triangles) {
        const double error = error_of(triangle, place);
        any = std::max(any, error);
        if (may_reach(triangle, place, pixel.reach)) covering = std::max(covering, error);
    }
    return covering < 0 ? any : covering;
}

/// For depths.
double largest_error(const Camera& camera, const std::vector<PictureTriangle>& triangles,
                     const CoveredPixel& pixel) {
    return largest_error(camera, triangles, pixel,
                         [&](const PictureTriangle& triangle, const glm::dvec2& place) {
                             return error_of(triangle, place, pixel.reach);
                         });
}

/// The largest w of a triangle's plane in a square of the picture, which is its view depth, and
/// infinite where the plane's horizon crosses it, and where it is no number; 1 where lines of sight
/// are parallel.
double largest_w(const Scene& scene, std::uint32_t triangle, const glm::dvec2& middle,
                 double half) {
    if (scene.camera.is_orthographic()) return 1;
    const glm::dvec3 a = corner(scene, triangle, 0);
    const glm::dvec3 across =
        glm::cross(corner(scene, triangle, 1) - a, corner(scene, triangle, 2) - a);
    const double of_plane = glm::dot(a - scene.camera.eye, across);
    double least = std::numeric_limits<double>::infinity(); // inverse depth, linear in the picture
    for (const double x : {-half, half})
        for (const double y : {-half, half})
            least = std::min(
                least, glm::dot(line_of_sight(scene.camera, middle.x + x, middle.y + y), across) /
                           of_plane);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return least > 0 && least < infinity ? 1 / least : infinity;
}

/// Of a dark cap, in the order in which it is drawn: that of the light cap, reversed.
std::array<glm::dvec4, 3> far_corners(const Scene& casters, const std::vector<glm::vec3>& far_ends,
                                      std::uint32_t triangle) {
    const glm::uvec3& corners = casters.triangles[triangle];
    return {glm::dvec4(far_ends[corners.z], 1), glm::dvec4(far_ends[corners.y], 1),
            glm::dvec4(far_ends[corners.x], 1)};
}

std::vector<PictureTriangle> set_up(const Scene& scene, std::uint32_t triangle,
                                    const CoveredPixel& pixel) {
    const auto at = [&](int k) { return glm::dvec4(corner(scene, triangle, k), 1); };
    return set_up(scene.camera, {at(0), at(1), at(2)}, pixel.drawing);
}

} // namespace

std::vector<PictureTriangle> set_up(const Camera& camera, const std::array<glm::dvec4, 3>& corners,
                                    const Drawing& drawing) {
    return fan_of(clipped_polygon(camera, corners, drawing));
}

std::vector<PictureTriangle> fan_of(const std::vector<PicturePoint>& polygon) {
    std::vector<PictureTriangle> fan;
    for (std::size_t i = 2; i < polygon.size(); ++i)
        fan.push_back({polygon[0], polygon[i - 1], polygon[i]});
    return fan;
}

bool may_reach(const std::array<PicturePoint, 3>& triangle, const glm::dvec2& pixel, double reach) {
    const double area =
        cross(triangle[1].place - triangle[0].place, triangle[2].place - triangle[0].place);
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec2 from = triangle[i].place;
        const glm::dvec2 along = triangle[(i + 1) % 3].place - from;
        const double inside = cross(along, pixel - from) * (area < 0 ? -1 : 1);
        if (inside < -reach * glm::length(along)) return false;
    }
    return true;
}

double setup_error(const Scene& scene, std::uint32_t triangle, const CoveredPixel& pixel) {
    return largest_error(scene.camera, set_up(scene, triangle, pixel), pixel);
}

// It is set up as the key is, of its own values at the corners.
std::vector<PictureTriangle> with_inverse_w(std::vector<PictureTriangle> triangles) {
    for (PictureTriangle& triangle : triangles)
        for (PicturePoint& point : triangle) {
            point.key = point.inverse_w;
            point.depth_error = point.w_error;
        }
    return triangles;
}

double inverse_w_error(const Scene& scene, std::uint32_t triangle, const CoveredPixel& pixel) {
    return largest_error(scene.camera, with_inverse_w(set_up(scene, triangle, pixel)), pixel);
}

double setup_error(const PictureTriangle& triangle, const glm::dvec2& place, double reach) {
    return error_of(triangle, place, reach);
}

bool may_be_flipped(const PictureTriangle& triangle, double reach) {
    return !(twice_area(triangle) > change_of_area(triangle, reach)); // or no number
}

// A, as error_from has it, is off by 3 v of its terms and v of itself, whichever corner is first:
// no term is larger than the product of the triangle's extents.
bool may_have_no_area(const PictureTriangle& triangle) {
    const auto& [a, b, c] = triangle;
    const glm::dvec2 extent = glm::max(glm::max(a.place, b.place), c.place) -
                              glm::min(glm::min(a.place, b.place), c.place);
    const double area = twice_area(triangle);
    return area <= v * (6 * extent.x * extent.y + area);
}

bool may_be_flipped(const Scene& scene, std::uint32_t triangle, const CoveredPixel& pixel) {
    const glm::dvec2 place = place_of(scene.camera, pixel.line);
    return std::ranges::any_of(set_up(scene, triangle, pixel), [&](const PictureTriangle& part) {
        return may_hold({part.begin(), part.end()}, place, std::numbers::sqrt2 * pixel.reach) &&
               may_be_flipped(part, pixel.reach);
    });
}

// It grows to all sides as sizes of linear functions do, so that no pixel has more than the corners
// of a region that holds it.
double largest_setup_error(const std::array<PicturePoint, 3>& triangle, double reach) {
    double largest = 0;
    for (const PicturePoint& corner : triangle)
        for (const double x : {-reach, reach})
            for (const double y : {-reach, reach})
                largest =
                    std::max(largest, error_of(triangle, corner.place + glm::dvec2(x, y), reach));
    return largest;
}

double attribute_error(const Scene& scene, std::uint32_t triangle, const CoveredPixel& pixel,
                       double variation) {
    const std::vector<PictureTriangle> fan = set_up(scene, triangle, pixel);
    if (fan.empty()) return std::numeric_limits<double>::infinity();
    const glm::dvec2 steepest = steepest_slope(fan, variation);
    const double error = largest_error(
        scene.camera, fan, pixel, [&](const PictureTriangle& one, const glm::dvec2& place) {
            return attribute_error_of(one, place, variation, steepest,
                                      weights_of(one, place, pixel.reach),
                                      MadePlaces::are_errors_of_values);
        });
    if (scene.camera.is_orthographic()) return error_of_quotient(error, 1);
    const glm::dvec3 a = corner(scene, triangle, 0);
    const glm::dvec3 across =
        glm::cross(corner(scene, triangle, 1) - a, corner(scene, triangle, 2) - a);
    const double depth = std::abs(depth_on_plane(scene.camera.eye, pixel.line, a, across));
    return error_of_quotient(error, depth);
}

DrawnAttribute drawn_attribute(const Scene& scene, std::uint32_t triangle,
                               const CoveredPixel& pixel) {
    constexpr double variation = 2;
    const std::vector<PictureTriangle> fan = set_up(scene, triangle, pixel);
    const glm::dvec2 steepest = steepest_slope(fan, variation);
    const glm::dvec2 place = place_of(scene.camera, pixel.line);
    DrawnAttribute covering;
    DrawnAttribute any;
    bool covers = false;
    const auto add = [](const DrawnAttribute& drawn, DrawnAttribute& to) {
        to = {std::max(to.share, drawn.share), std::max(to.aside, drawn.aside)};
    };
    for (const PictureTriangle& one : fan) {
        const double farthest = farthest_aside(one, pixel.reach);
        const Weights weights = drawn_weights(one, place, farthest);
        const DrawnAttribute drawn{attribute_error_of(one, place, variation, steepest, weights,
                                                      MadePlaces::are_told_apart),
                                   clipping_aside(one, weights)};
        add(drawn, any);
        if (!may_reach(one, place, farthest)) continue;
        add(drawn, covering);
        covers = true;
    }
    const DrawnAttribute found = covers ? covering : any;
    const double w = largest_w(scene, triangle, place, pixel.reach + found.aside);
    const double share = error_of_quotient(found.share, w);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (fan.empty() || !std::isfinite(share) || !std::isfinite(found.aside))
        return {infinity, infinity};
    return {share, found.aside};
}

double interpolated_place_error(const Scene& scene, std::uint32_t triangle,
                                const CoveredPixel& pixel, const glm::dvec3& origin) {
    double largest = 0;
    double variation = 0;
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 from = corner(scene, triangle, k);
        const glm::dvec3 away = glm::abs(from - origin);
        const glm::dvec3 apart = glm::abs(corner(scene, triangle, (k + 1) % 3) - from);
        largest = std::max({largest, away.x, away.y, away.z});
        variation = std::max({variation, apart.x, apart.y, apart.z});
    }
    return largest > 0 ? attribute_error(scene, triangle, pixel, variation / largest) * largest : 0;
}

double setup_error(const Scene& casters, const std::vector<glm::vec3>* far_ends,
                   const Crossing& face, const CoveredPixel& pixel) {
    std::vector<PictureTriangle> triangles;
    const auto add = [&](const std::array<glm::dvec4, 3>& corners) {
        for (const PictureTriangle& triangle : set_up(casters.camera, corners, pixel.drawing))
            triangles.push_back(triangle);
    };
    if (face.part == Crossing::Part::light_cap) {
        // Of a triangle that is counted flipped the cap is drawn as the triangle was before.
        const auto at = [&](int k) { return glm::dvec4(corner(casters, face.triangle, k), 1); };
        add(face.flipped ? std::array{at(1), at(0), at(2)} : std::array{at(0), at(1), at(2)});
    } else if (face.is_side())
        for (const std::array<glm::dvec4, 3>& half :
             triangles_of_side(casters, far_ends, face.triangle, static_cast<int>(face.part)))
            add(half);
    else if (far_ends != nullptr)
        add(far_corners(casters, *far_ends, face.triangle));
    return largest_error(casters.camera, triangles, pixel);
}

} // namespace shadowproof
