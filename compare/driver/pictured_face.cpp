#include "compare/driver/pictured_face.h"

#include "compare/driver/setup_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

namespace shadowproof {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// The last pixel centre, as a column's number, that is not past a place; and the first. The place
/// is a number. (std::floor and std::ceil are calls on machines without SSE 4.1, and these are
/// asked for every row of every face.)
int last_column(double place, int width) {
    const double centre = std::clamp(place - 0.5, -1.0, double(width));
    return centre < 0 ? -1 : static_cast<int>(centre);
}
int first_column(double place, int width) {
    const double centre = std::clamp(place - 0.5, -1.0, double(width));
    const int towards_zero = static_cast<int>(centre);
    return towards_zero + (centre > towards_zero ? 1 : 0);
}

} // namespace

PixelRun either(const PixelRun& one, const PixelRun& other) {
    if (one.length() == 0) return other;
    if (other.length() == 0) return one;
    return {std::min(one.first, other.first), std::max(one.end, other.end)};
}

ConvexRegion ConvexRegion::everywhere() {
    ConvexRegion all;
    all.low_ = glm::dvec2(-infinity);
    all.high_ = glm::dvec2(infinity);
    return all;
}

// Where corners move by up to `margin` on both axes, a point is drawn whatever they do if the
// square of that half side around it lies within the polygon: the support of the square in the
// direction of a normal is the margin times the sum of the normal's sizes. And it may be drawn only
// where the square meets the polygon. An edge's normal points outwards on that side where no other
// corner lies; a polygon without an area has both sides, and holds no square.
ConvexRegion::ConvexRegion(const std::vector<PicturePoint>& polygon, double margin) {
    if (polygon.empty()) return;
    assert(polygon.size() + 1 < most_bounds);
    low_ = glm::dvec2(infinity);
    high_ = glm::dvec2(-infinity);
    double area = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        low_ = glm::min(low_, polygon[i].place);
        high_ = glm::max(high_, polygon[i].place);
        if (i >= 2)
            area +=
                cross(polygon[i - 1].place - polygon[0].place, polygon[i].place - polygon[0].place);
    }
    low_ += margin;
    high_ -= margin;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 from = polygon[i].place;
        const glm::dvec2 along = polygon[(i + 1) % polygon.size()].place - from;
        if (along.x == 0 && along.y == 0) continue;
        const glm::dvec2 normal = glm::dvec2(along.y, -along.x) * (area < 0 ? -1.0 : 1.0);
        double most = glm::dot(normal, from);
        if (margin < 0)
            for (const PicturePoint& point : polygon)
                most = std::max(most, glm::dot(normal, point.place));
        bound(normal, most - margin * (std::abs(normal.x) + std::abs(normal.y)));
    }
}

void ConvexRegion::bound(const glm::dvec2& normal, double most) {
    if (normal.x == 0) {
        if (normal.y > 0) high_.y = std::min(high_.y, most / normal.y);
        if (normal.y < 0) low_.y = std::max(low_.y, most / normal.y);
        return;
    }
    bounds_[count_++] = {most / normal.x, -normal.y / normal.x, normal.x < 0};
}

bool ConvexRegion::holds(const glm::dvec2& place) const {
    if (!(place.x >= low_.x && place.x <= high_.x && place.y >= low_.y && place.y <= high_.y))
        return false;
    return std::all_of(bounds_.begin(), bounds_.begin() + count_, [&](const Bound& bound) {
        const double x = bound.at + bound.slope * place.y;
        return bound.lower ? place.x >= x : place.x <= x;
    });
}

PixelRun ConvexRegion::rows(int height) const {
    if (!(low_.x <= high_.x && low_.y <= high_.y)) return {};
    const PixelRun run{first_column(low_.y, height), last_column(high_.y, height) + 1};
    return {std::max(run.first, 0), std::min(run.end, height)};
}

PixelRun ConvexRegion::row(int y, int width) const {
    const double centre = y + 0.5;
    if (centre < low_.y || centre > high_.y) return {};
    double left = low_.x;
    double right = high_.x;
    for (std::size_t i = 0; i < count_; ++i) {
        const double x = bounds_[i].at + bounds_[i].slope * centre;
        if (bounds_[i].lower)
            left = std::max(left, x);
        else
            right = std::min(right, x);
    }
    if (!(left <= right)) return {};
    return {std::max(first_column(left, width), 0), std::min(last_column(right, width) + 1, width)};
}

namespace {

/// Whether floats determine the direction in which a corner lies. If not, it may be drawn anywhere.
/// Where lines of sight are parallel, a corner that is not at infinity has its place, and one that
/// is lies in the direction of its place.
bool has_direction(const PictureMaking& making, const ViewCorner& corner) {
    if (making.camera.is_orthographic())
        return corner.at.w > 0 ||
               glm::length(glm::dvec2(corner.error)) < 0.25 * glm::length(glm::dvec2(corner.at));
    return glm::length(corner.error) < 0.25 * glm::length(glm::dvec3(corner.at));
}

/// Whether the eye, as far as floats tell, lies on an edge, which may reach to infinity, and no
/// near plane cuts it off.
bool has_eye_on_outline(const PictureMaking& making, const std::array<ViewCorner, 3>& corners) {
    if (making.camera.is_orthographic() || making.drawing.near > 0) return false;
    const auto passes_eye = [](const ViewCorner& from, const ViewCorner& to) {
        if (from.at.w == 0) return false;
        const glm::dvec3 start(from.at);
        const glm::dvec3 along = glm::dvec3(to.at) - to.at.w * start;
        const double squared = glm::dot(along, along);
        const double most = to.at.w == 0 ? infinity : 1;
        const double t = squared > 0 ? std::clamp(-glm::dot(start, along) / squared, 0.0, most) : 0;
        const double error =
            glm::length(from.error) + (to.at.w == 0 ? t : 1) * glm::length(to.error);
        return glm::length(start + t * along) <= error;
    };
    for (std::size_t k = 0; k < 3; ++k)
        if (passes_eye(corners[k], corners[(k + 1) % 3]) ||
            passes_eye(corners[(k + 1) % 3], corners[k]))
            return true;
    return false;
}

// A corner that clipping makes is put together with a weight that is itself rounded, in its
// difference and quotient: by up to 2 v of the edge, which is up to 4 v of the larger corner,
// beside the 3 v that clipped_polygon counts.
double place_error_of(const PicturePoint& point) {
    return point.place_error * (point.made_by_clipping ? 7.0 / 3.0 : 1.0);
}

std::optional<double> margin_of(const PictureMaking& making,
                                const std::vector<PicturePoint>& polygon) {
    double margin = 0;
    for (const PicturePoint& point : polygon) {
        const double error = place_error_of(point);
        // Not a number where it lies in the eye.
        if (!(error < infinity) || !std::isfinite(point.place.x) || !std::isfinite(point.place.y))
            return std::nullopt;
        margin = std::max(margin, error);
    }
    return making.half_step + margin;
}

/// Whether none of the triangles that a polygon is cut into may be drawn flipped.
bool stays_as_wound(const PictureMaking& making, const std::vector<PicturePoint>& polygon) {
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        std::array<PicturePoint, 3> part{polygon[0], polygon[i - 1], polygon[i]};
        for (PicturePoint& corner : part) corner.place_error = place_error_of(corner);
        if (may_be_flipped(part, making.half_step)) return false;
    }
    return true;
}

struct Regions {
    ConvexRegion certain;
    ConvexRegion possible;
    std::optional<double> margin; ///< of the possible one
    bool is_wide = false; ///< it covers some place whatever its corners do, and so never flips
};

Regions regions_of(const PictureMaking& making, const std::vector<PicturePoint>& most,
                   const std::vector<PicturePoint>& least) {
    Regions regions{{}, ConvexRegion::everywhere(), margin_of(making, most), false};
    if (!regions.margin) return regions;
    regions.possible = ConvexRegion(most, -*regions.margin);
    if (const std::optional<double> margin = margin_of(making, least)) {
        regions.certain = ConvexRegion(least, *margin);
        glm::dvec2 sum(0);
        for (const PicturePoint& point : least) sum += point.place;
        regions.is_wide = regions.certain.holds(sum / double(least.size()));
    }
    return regions;
}

/// What the picture makes of a view corner: its place is x and y over the last component, which is
/// the depth or, where lines of sight are parallel, w.
struct PictureCorner {
    glm::dvec3 at{0, 0, 0};
    double error = 0;
    double nearness = 0; ///< times the last component
};
PictureCorner picture_corner(const PictureMaking& making, const ViewCorner& corner) {
    const glm::dvec4& at = corner.at;
    const glm::dvec3& error = corner.error;
    if (!making.camera.is_orthographic()) return {glm::dvec3(at), glm::length(error), at.w};
    return {{at.x, at.y, at.w}, glm::length(glm::dvec2(error)), -at.z};
}

/// The nearness of a plane through three corners is linear in their places: the coefficients that
/// give each corner's.
glm::dvec3 plane_of(const std::array<PictureCorner, 3>& corners) {
    const auto& [a, b, c] = corners;
    const glm::dvec3 sum = a.nearness * glm::cross(b.at, c.at) +
                           b.nearness * glm::cross(c.at, a.at) +
                           c.nearness * glm::cross(a.at, b.at);
    return sum / glm::dot(a.at, glm::cross(b.at, c.at));
}

/// Whether the front (+1) or the back (-1) of a triangle is seen; 0 where errors of its corners may
/// reverse that. Right, up and forward make a left-handed frame: the determinant of corners that
/// run anticlockwise as seen from the eye is positive. It is linear in each corner.
int seen_side(const std::array<PictureCorner, 3>& corners) {
    const glm::dvec3& a = corners[0].at;
    const glm::dvec3& b = corners[1].at;
    const glm::dvec3& c = corners[2].at;
    const double da = corners[0].error;
    const double db = corners[1].error;
    const double dc = corners[2].error;
    const double once = da * glm::length(glm::cross(b, c)) + db * glm::length(glm::cross(c, a)) +
                        dc * glm::length(glm::cross(a, b));
    const double twice =
        da * db * glm::length(c) + db * dc * glm::length(a) + dc * da * glm::length(b);
    const double determinant = glm::dot(a, glm::cross(b, c));
    if (!(std::abs(determinant) > once + twice + da * db * dc)) return 0;
    return determinant > 0 ? 1 : -1;
}

/// As coefficients of pixels.
glm::dvec3 in_pixels(const Camera& camera, const glm::dvec3& plane) {
    const glm::dvec2 half = half_extent(camera);
    return {plane.x * 2 * half.x / camera.width, -plane.y * 2 * half.y / camera.height,
            plane.z - plane.x * half.x + plane.y * half.y};
}

// A polygon is cut into triangles from any of its corners: any three of them may be one. A depth is
// off by what its set-up is, and by as much as it changes over what the corners are drawn aside.
std::vector<DepthError> depth_errors(const std::vector<PicturePoint>& polygon, double margin,
                                     const glm::dvec3& nearness) {
    const double aside = margin * (std::abs(nearness.x) + std::abs(nearness.y));
    std::vector<DepthError> parts;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        for (std::size_t j = i + 1; j < polygon.size(); ++j)
            for (std::size_t k = j + 1; k < polygon.size(); ++k) {
                const std::array<PicturePoint, 3> part{polygon[i], polygon[j], polygon[k]};
                const double error = aside + largest_setup_error(part, margin);
                parts.push_back({ConvexRegion({part.begin(), part.end()}, -margin),
                                 std::isfinite(error) ? error : infinity});
            }
    return parts;
}

} // namespace

// Scaling a corner at infinity moves nothing, but clipping rounds by the size of the larger corner.
double margin_by_size(const PictureMaking& making, const std::array<glm::dvec4, 3>& corners) {
    double size = 0;
    for (const glm::dvec4& corner : corners)
        size = std::max(size, glm::length(glm::dvec3(corner) - corner.w * making.camera.eye));
    std::vector<ViewCorner> polygon;
    for (glm::dvec4 corner : corners) {
        const double length = glm::length(glm::dvec3(corner));
        if (corner.w == 0 && length > 0) corner *= size / length;
        polygon.push_back(viewed(making.camera, corner, making.drawing));
    }
    const std::vector<PicturePoint> most =
        clipped_polygon(making.camera, polygon, making.drawing, PlaneCut::most);
    return margin_of(making, most).value_or(infinity);
}

// A direction from the light is made of the light as two floats, which leave 2^-48 of it away. Two
// triangles with an edge in common cover a point once that lies within both together, whatever
// their corners do as long as none of the four edges around them passes over it: how often those go
// around it is the sum of how often, with its sign, either triangle covers it.
PicturedFace pictured_face(const PictureMaking& making, const std::array<glm::dvec4, 3>& corners,
                           const glm::dvec4* other, double light_size) {
    const auto seen_of = [&](const glm::dvec4& corner) {
        ViewCorner seen = viewed(making.camera, corner, making.drawing);
        if (corner.w == 0) seen.error += 0x1p-48 * light_size;
        return seen;
    };
    const std::array<ViewCorner, 3> seen{seen_of(corners[0]), seen_of(corners[1]),
                                         seen_of(corners[2])};
    PicturedFace face;
    const auto is_known = [&](const ViewCorner& corner) { return has_direction(making, corner); };
    if (!std::all_of(seen.begin(), seen.end(), is_known)) {
        face.possible = ConvexRegion::everywhere();
        face.margin = infinity;
        face.edge_on = true;
        return face;
    }
    const auto left = [&](const std::vector<ViewCorner>& polygon, PlaneCut cut) {
        return clipped_polygon(making.camera, polygon, making.drawing, cut);
    };
    std::vector<ViewCorner> polygon(seen.begin(), seen.end());
    const std::vector<PicturePoint> most = left(polygon, PlaneCut::most);
    const Regions regions = regions_of(making, most, left(polygon, PlaneCut::least));
    face.certain = regions.certain;
    face.certain_of_both = regions.certain;
    if (other != nullptr) {
        polygon.push_back(seen_of(*other));
        const std::vector<PicturePoint> both = left(polygon, PlaneCut::least);
        const std::optional<double> margin = margin_of(making, both);
        const bool known = is_known(polygon.back()) && margin;
        face.certain_of_both = known ? ConvexRegion(both, *margin) : ConvexRegion();
        face.is_one_of_two = true;
    }
    face.possible = regions.possible;
    face.margin = regions.margin.value_or(infinity);
    if (most.size() > 3 && has_eye_on_outline(making, seen))
        face.times = static_cast<std::uint32_t>(most.size()) - 2;
    const std::array<PictureCorner, 3> pictured{picture_corner(making, seen[0]),
                                                picture_corner(making, seen[1]),
                                                picture_corner(making, seen[2])};
    face.change = regions.is_wide || stays_as_wound(making, most) ? seen_side(pictured) : 0;
    face.nearness = in_pixels(making.camera, plane_of(pictured));
    const glm::dvec3& nearness = face.nearness;
    face.edge_on = !regions.margin || !std::isfinite(nearness.x + nearness.y + nearness.z);
    if (!face.edge_on) face.parts = depth_errors(most, *regions.margin, nearness);
    return face;
}

Drawing drawing_of_layers(Drawing drawing) {
    drawing.near = drawing.parallel_range > 0 ? -infinity : 0;
    drawing.far = infinity;
    return drawing;
}

PicturedFace pictured_layer(const PictureMaking& making, const std::vector<ViewCorner>& most,
                            const std::vector<ViewCorner>& least) {
    PicturedFace face;
    face.in_front = true;
    const Drawing drawing = drawing_of_layers(making.drawing);
    if (!std::ranges::all_of(
            most, [&](const ViewCorner& corner) { return has_direction(making, corner); })) {
        face.possible = ConvexRegion::everywhere();
        face.margin = infinity;
        return face;
    }
    const Regions regions =
        regions_of(making, clipped_polygon(making.camera, most, drawing, PlaneCut::nominal),
                   clipped_polygon(making.camera, least, drawing, PlaneCut::nominal));
    face.certain = regions.certain;
    face.certain_of_both = regions.certain;
    face.possible = regions.possible;
    face.margin = regions.margin.value_or(infinity);
    return face;
}

} // namespace shadowproof
