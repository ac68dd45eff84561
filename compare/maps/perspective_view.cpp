#include "compare/maps/perspective_view.h"

#include "compare/driver/clipped_polygon.h"
#include "compare/driver/error_bounds.h"
#include "compare/driver/mask_errors.h"
#include "compare/driver/neighbourhood.h"
#include "compare/driver/setup_error.h"
#include "reference/parallel.h"
#include "reference/trace/areas.h"
#include "reference/trace/faces.h"
#include "reference/trace/first_met.h"
#include "scenes/driver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <utility>

namespace shadowproof {

namespace {

constexpr double v = float_roundoff;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// The casters before the face's camera, as they are drawn: the order of a triangle's corners
/// decides into which ones clipping divides it.
Scene casters_of(const Scene& scene, const MapModel& model, std::size_t face,
                 std::vector<std::uint32_t>& of_scene) {
    Scene casters = casters_alone(scene, model.culling == MapCulling::none, of_scene);
    casters.camera = map_camera(chosen_light(scene), model, face);
    return casters;
}

/// As a tracer sees them, which leaves out backs: turned over where fronts are left out.
Scene seen_from_light(Scene casters, MapCulling culling) {
    if (culling == MapCulling::front)
        for (glm::uvec3& corners : casters.triangles) std::swap(corners.y, corners.z);
    return casters;
}

} // namespace

PerspectiveView::PerspectiveView(const Scene& scene, const MapEvidence& map, int subpixel_bits,
                                 int threads)
    : LightView(scene, map), depth_model_(map_depth_model(map.model)) {
    depth_model_.subpixel_bits = subpixel_bits;
    for (std::size_t face = 0; face < map.model.faces(); ++face)
        faces_.push_back(casters_of(scene, map.model, face, of_scene_));
    for (const Scene& casters : faces_) {
        pictures_.push_back(depth_picture(casters, depth_model_,
                                          drawing_of(casters, depth_model_, map.model.far),
                                          map.model.far));
        std::vector<glm::dvec3>& columns = columns_.emplace_back();
        std::vector<glm::dvec3>& rows = rows_.emplace_back();
        for (int i = 0; i < map.model.size; ++i) {
            columns.push_back(sight_column(casters.camera, i + 0.5));
            rows.push_back(sight_row(casters.camera, i + 0.5));
        }
    }
    caster_at_ = inverse_of(of_scene_, scene.triangles.size());
    for (std::uint32_t caster = 0; caster < of_scene_.size(); ++caster)
        planes_.push_back(plane_before_eye(faces_.front(), caster));
    seen_ = seen_from_light(faces_.front(), map.model.culling);
    if (!of_scene_.empty()) tracer_ = std::make_unique<Tracer>(seen_, threads);
}

void PerspectiveView::trace(std::span<const Texel> texels, const FoundTriangle& found) const {
    const auto find = [&](std::size_t i, std::uint32_t caster) {
        found(i, caster == no_triangle ? no_triangle : of_scene_[caster]);
    };
    if (!tracer_) {
        for (std::size_t i = 0; i < texels.size(); ++i) find(i, no_triangle);
        return;
    }
    const std::vector<std::size_t> left = without_rays(texels, find);
    see_triangles(
        *tracer_, range_of(seen_.camera), left.size(),
        [&](std::size_t ray) { return direction(texels[left[ray]]); },
        [&](std::size_t ray, std::uint32_t caster) { find(left[ray], caster); });
}

/// What areas of the faces tell; the texels that are left.
std::vector<std::size_t> PerspectiveView::without_rays(std::span<const Texel> texels,
                                                       const FoundTriangle& found) const {
    std::vector<std::size_t> left;
    if (!Areas::are_worth(*tracer_, texels.size())) {
        left.resize(texels.size());
        std::iota(left.begin(), left.end(), std::size_t{0});
        return left;
    }
    std::vector<Areas> areas;
    std::vector<Camera> cameras;
    for (std::size_t face = 0; face < faces_.size(); ++face) {
        areas.emplace_back(model().size, model().size);
        cameras.push_back(camera(face));
    }
    for (const Texel& texel : texels) areas[texel.face].ask(texel.x, texel.y);
    Areas::divide(areas, cameras, *tracer_);
    constexpr std::size_t together = 4096;
    std::vector<std::vector<std::size_t>> left_of(texels.size() / together + 1);
    parallel_for_all(
        texels.size(), tracer_->threads(),
        [&](std::size_t i) {
            const Texel& texel = texels[i];
            const std::uint32_t caster = areas[texel.face].at(texel.x, texel.y);
            if (caster == Areas::untold)
                left_of[i / together].push_back(i);
            else
                found(i, caster);
        },
        together);
    for (const std::vector<std::size_t>& some : left_of)
        left.insert(left.end(), some.begin(), some.end());
    return left;
}

std::vector<FromLight> PerspectiveView::trace_without(const LiftedLimits& lifted,
                                                      std::span<const Texel> texels) const {
    std::vector<glm::dvec3> rays;
    rays.reserve(texels.size());
    for (const Texel& texel : texels) rays.push_back(direction(texel));
    return met(rays, lifted);
}

// A face's camera sees nothing behind it.
std::vector<FromLight> PerspectiveView::trace_to(std::span<const PointOnFace> points,
                                                 const LiftedLimits& lifted) const {
    const auto depth_of = [&](const PointOnFace& point) {
        return glm::dot(point.from_light, camera(point.face).forward);
    };
    std::vector<glm::dvec3> rays;
    rays.reserve(points.size());
    for (const PointOnFace& point : points) {
        const double depth = depth_of(point);
        rays.push_back(depth > 0 ? point.from_light / depth : camera(point.face).forward);
    }
    std::vector<FromLight> found = met(rays, lifted);
    for (std::size_t i = 0; i < points.size(); ++i)
        if (!(depth_of(points[i]) > 0)) found[i] = {no_triangle, infinity};
    return found;
}

// Few rays are not worth what see_triangles sets up.
std::vector<FromLight> PerspectiveView::met(std::span<const glm::dvec3> rays,
                                            const LiftedLimits& lifted) const {
    std::vector<FromLight> found(rays.size(), {no_triangle, infinity});
    if (!tracer_) return found;
    const SeenRange range = lifted.range ? SeenRange{} : range_of(seen_.camera);
    const bool culls = model().culling != MapCulling::none && !lifted.culling;
    const auto any_ray = [&](std::size_t i) {
        return AnyRay{origin(), rays[i], range.near, range.far};
    };
    const auto keep = [&](std::size_t i, std::uint32_t caster) {
        if (caster == no_triangle) return;
        const double depth = place_on_plane(any_ray(i), corners(seen_, caster));
        found[i] = {of_scene_[caster], depth};
    };
    constexpr std::size_t few = 64;
    if (rays.size() > few && (culls || model().culling == MapCulling::none)) {
        see_triangles(
            *tracer_, range, rays.size(), [&](std::size_t i) { return rays[i]; }, keep);
        return found;
    }
    std::vector<AnyRay> any_rays;
    any_rays.reserve(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) any_rays.push_back(any_ray(i));
    const auto counts = [&](std::uint32_t caster) {
        return !culls || side(seen_, caster, {origin(), 1}) > 0;
    };
    const std::vector<MetTriangle> first = first_met(*tracer_, any_rays, counts);
    for (std::size_t i = 0; i < first.size(); ++i) keep(i, first[i].triangle);
    return found;
}

PlaneAtPixel PerspectiveView::plane(const Texel& texel, std::uint32_t caster) const {
    return {pictures_[texel.face], caster, planes_[caster], direction(texel)};
}

double PerspectiveView::value(const PlaneAtPixel& plane) const {
    const double depth = 1 / plane.key();
    return model().value == MapValue::depth ? depth : depth * glm::length(plane.line());
}

std::uint32_t PerspectiveView::caster_of(std::uint32_t triangle) const {
    return caster_at_[triangle];
}

// The window depths of corners are rounded as they are, and not as little as their inverse depths.
PolygonOffset PerspectiveView::offset(const Texel& texel, std::uint32_t caster) const {
    if (!model().has_offset()) return {};
    const Scene& scene = faces_[texel.face];
    const WindowDepth& window = pictures_[texel.face].window;
    const auto at = [&](int k) { return glm::dvec4(corner(scene, caster, k), 1); };
    std::vector<PicturePoint> polygon =
        clipped_polygon(scene.camera, {at(0), at(1), at(2)}, pictures_[texel.face].drawing);
    for (PicturePoint& point : polygon)
        point.depth_error += window_depth_roundings * v / std::abs(window.slope);
    return polygon_offset(polygon, {texel.x + 0.5, texel.y + 0.5}, model(), offset_unit(),
                          {window.at(0), window.slope},
                          half_snapping_step(depth_model_.subpixel_bits));
}

double PerspectiveView::moved_away(const Texel& texel, std::uint32_t triangle, double depth) const {
    return moved_by(depth, offset(texel, caster_of(triangle)).own);
}

/// The largest window depth at which the driver may draw a caster at a texel.
double PerspectiveView::deepest(const Texel& texel, std::uint32_t caster) const {
    const PlaneAtPixel at = plane(texel, caster);
    if (!at.has_depth()) return infinity;
    const WindowDepth& window = pictures_[texel.face].window;
    return window.at(at.key()) + std::abs(window.slope) * at.error() + half_step() +
           offset(texel, caster).most;
}

// The sum of depth and offset rounds once more.
bool PerspectiveView::may_store_moved(const PlaneAtPixel& at, const Texel& texel,
                                      std::uint32_t caster) const {
    const WindowDepth& window = pictures_[texel.face].window;
    const double depth = window.at(at.key());
    const double off = std::abs(window.slope) * at.error() + half_step() + v;
    const PolygonOffset moved = offset(texel, caster);
    return stored(texel) >= std::min(depth + moved.least, 1.0) - off &&
           stored(texel) <= depth + moved.most + off;
}

// The depth on a ramp is a component of a vector that is interpolated over the triangle: off by the
// lateral error of the place, by the interpolation's share of the largest corner's components, and
// by the roundings of its rotation into the light's axes: an entry, a product and two sums. Its
// place on the ramp: two differences, a quotient, and the sampler's product with the number of
// texels.
bool PerspectiveView::may_store_step(const PlaneAtPixel& at, const Texel& texel,
                                     std::uint32_t caster) const {
    const auto read = static_cast<int>(std::lround(stored(texel) * (ramp_steps - 1)));
    const auto within = [&](double error_of_inverse, double interpolated) {
        const double inverse = at.key();
        const double high =
            inverse > error_of_inverse ? 1 / (inverse - error_of_inverse) : infinity;
        const double low = 1 / (inverse + error_of_inverse);
        const glm::dvec3 size = glm::abs(at.line());
        const double rotated = 4 * v * (size.x + size.y + size.z) / inverse;
        const auto step = [&](double depth, double sign) {
            const double place = place_on_ramp(model(), depth + sign * (rotated + interpolated));
            return ramp_step(place + sign * 4 * v * std::abs(place));
        };
        return read >= step(low, -1) && read <= step(high, +1);
    };
    if (within(0, 0)) return true;
    const Scene& scene = faces_[texel.face];
    const CoveredPixel pixel{at.line(), at.lateral(), pictures_[texel.face].drawing};
    return within(at.error_of_place(),
                  std::sqrt(3.0) *
                      interpolated_place_error(scene, caster, pixel, scene.camera.eye));
}

// A distance is the length of a vector that is interpolated over the triangle: off by the lateral
// error of the place, as the plane's depth is, by the interpolation's share of the largest corner's
// components, and by the roundings of a length, a quotient and the format: 8 v.
bool PerspectiveView::may_store(const PlaneAtPixel& at, const Texel& texel,
                                std::uint32_t caster) const {
    if (!at.has_depth()) return true; // seen edge-on: any depth may come out
    const double read = stored(texel);
    if (model().is_ramp()) return may_store_step(at, texel, caster);
    if (model().has_offset()) return may_store_moved(at, texel, caster);
    if (model().value == MapValue::depth) {
        if (at.is_depth(read)) return true;
        if (model().format != MapFormat::d16) return false; // is_depth knows the others
        const WindowDepth& window = pictures_[texel.face].window;
        return std::abs(read - window.at(at.key())) <=
               half_step() + std::abs(window.slope) * at.error();
    }
    const double inverse = at.key();
    const double far = model().far;
    // Most are off by roundings alone, which their squares tell without a root and a quotient:
    // where those differ by 15 v, the distances do by no more than 8.
    const double squared = glm::dot(at.line(), at.line());
    const double on_ray = read * far * inverse;
    if (inverse > 0 && std::abs(on_ray * on_ray - squared) <= 15 * v * squared) return true;
    const double length = std::sqrt(squared);
    const auto within = [&](double low, double high, double more) {
        const double roundings = 8 * v * high + more + half_step() * far;
        return read * far >= std::min(low - roundings, far) && read * far <= high + roundings;
    };
    const auto off_by = [&](double error_of_inverse, double error_of_direction, double more) {
        const double high = inverse > error_of_inverse
                                ? (length + error_of_direction) / (inverse - error_of_inverse)
                                : infinity;
        return within((length - error_of_direction) / (inverse + error_of_inverse), high, more);
    };
    if (off_by(0, 0, 0)) return true;
    const Scene& scene = faces_[texel.face];
    const CoveredPixel pixel{at.line(), at.lateral(), pictures_[texel.face].drawing};
    const double interpolated =
        std::sqrt(3.0) * interpolated_place_error(scene, caster, pixel, scene.camera.eye);
    return off_by(at.error_of_place(), std::sqrt(2.0) * at.spread(), interpolated);
}

LightView::Shown PerspectiveView::showing(const Texel& texel, std::uint32_t triangle) const {
    if (triangle == no_triangle) return {};
    const double exact = value(plane(texel, caster_of(triangle)));
    return {triangle, exact, moved_away(texel, triangle, exact)};
}

bool PerspectiveView::may_show(const Texel& texel, std::uint32_t triangle) const {
    const std::uint32_t caster = caster_of(triangle);
    return may_store(plane(texel, caster), texel, caster);
}

bool PerspectiveView::may_be_clipped(const Texel& texel, const SeenSurface& seen) const {
    if (seen.triangle == no_triangle) return false;
    const double to_near = 1 / model().near - 1 / seen.depth;
    const double to_far = 1 / seen.depth - 1 / model().far;
    const PlaneAtPixel at = plane(texel, seen.triangle);
    return !at.has_depth() || std::min(to_near, to_far) <= at.error();
}

/// What may be left of a caster in a face's picture.
std::vector<PicturePoint> PerspectiveView::pictured(std::size_t face, std::uint32_t caster) const {
    const Scene& scene = faces_[face];
    const Drawing& drawing = pictures_[face].drawing;
    std::vector<ViewCorner> corners;
    for (int k = 0; k < 3; ++k)
        corners.push_back(viewed(scene.camera, glm::dvec4(corner(scene, caster, k), 1), drawing));
    return clipped_polygon(scene.camera, std::move(corners), drawing, PlaneCut::most);
}

/// Of the casters that a face's picture may show. What lies wholly behind the camera, or beside
/// twice its picture, which is farther than anything is moved, is in none.
const CasterGrid& PerspectiveView::grid(std::size_t face) const {
    std::call_once(is_made_[face], [&] {
        const Scene& scene = faces_[face];
        const double wide = 2 * scene.camera.half_height;
        std::vector<CasterBox> boxes;
        for (std::uint32_t caster = 0; caster < scene.triangles.size(); ++caster) {
            std::array<glm::dvec3, 3> corners{};
            for (int k = 0; k < 3; ++k) {
                const glm::dvec3 at = corner(scene, caster, k) - scene.camera.eye;
                corners[static_cast<std::size_t>(k)] = {glm::dot(at, scene.camera.right),
                                                        glm::dot(at, scene.camera.up),
                                                        glm::dot(at, scene.camera.forward)};
            }
            const auto all = [&](const auto& is_out) {
                return std::ranges::all_of(corners, is_out);
            };
            if (all([&](const glm::dvec3& c) { return c.z <= 0; }) ||
                all([&](const glm::dvec3& c) { return c.x > wide * c.z; }) ||
                all([&](const glm::dvec3& c) { return -c.x > wide * c.z; }) ||
                all([&](const glm::dvec3& c) { return c.y > wide * c.z; }) ||
                all([&](const glm::dvec3& c) { return -c.y > wide * c.z; }))
                continue;
            const std::vector<PicturePoint> polygon = pictured(face, caster);
            if (polygon.empty()) continue;
            CasterBox box{caster, glm::dvec2(infinity), glm::dvec2(-infinity)};
            for (const PicturePoint& point : polygon) {
                box.low = glm::min(box.low, point.place - point.place_error);
                box.high = glm::max(box.high, point.place + point.place_error);
            }
            boxes.push_back(box);
        }
        grids_[face] = CasterGrid(std::move(boxes), model().size);
    });
    return grids_[face];
}

/// Whether the clipper, which moves the corners that it makes, may have made a triangle cover the
/// texel's centre.
bool PerspectiveView::clipping_may_draw(const Texel& texel, std::uint32_t caster,
                                        double reach) const {
    const Scene& scene = faces_[texel.face];
    const double half = scene.camera.half_height;
    bool is_cut = false;
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 at = corner(scene, caster, k) - scene.camera.eye;
        const double depth = glm::dot(at, scene.camera.forward);
        const double aside = std::max(std::abs(glm::dot(at, scene.camera.right)),
                                      std::abs(glm::dot(at, scene.camera.up)));
        // Also where it is next to a border, by far more than floats are off.
        is_cut = is_cut || !(depth > 2 * model().near) || !(1.5 * aside < half * depth);
    }
    if (!is_cut) return false;
    return may_hold(pictured(texel.face, caster), {texel.x + 0.5, texel.y + 0.5}, reach);
}

// Next to an outline any triangle that may cover the centre may be stored, none farther than what
// is seen all around. What lies as near to the near or far plane as its depth is off may be
// clipped, and hides nothing.
std::optional<std::uint32_t> PerspectiveView::shown_around(const Texel& texel) const {
    if (!tracer_) return std::nullopt;
    const Scene& scene = faces_[texel.face];
    const glm::dvec3 centre = direction(texel);
    const double reach =
        lateral_error(scene, depth_model_, scene.camera.eye + model().near * centre);
    Neighbourhood around =
        neighbourhood(scene.camera, {texel.x + 0.5, texel.y + 0.5}, {reach, reach});
    if (has_masks(scene)) read_masks_in_all_ways(around);
    const DriverMaskErrors errors(scene, depth_model_, pictures_[texel.face].drawing);
    double farthest = 0;
    double deepest_seen = 0; // as a window depth; with a polygon offset
    for (const SeenSurface& seen : see_rays(*tracer_, around.rays, {around.readings, &errors})) {
        const bool clipped = may_be_clipped(texel, seen);
        if ((seen.triangle == no_triangle || clipped) && stored(texel) == 1) return no_triangle;
        if (model().has_offset())
            deepest_seen = std::max(deepest_seen, clipped || seen.triangle == no_triangle
                                                      ? infinity
                                                      : deepest(texel, seen.triangle));
        farthest = std::max(farthest, clipped ? infinity : seen.depth);
    }
    // `nearest` is an inverse depth.
    const auto may_show = [&](std::uint32_t caster, double nearest) {
        if (!may_stand(*tracer_, around, errors, caster)) return false;
        if (model().has_offset())
            return stored(texel) <= deepest_seen && may_store(plane(texel, caster), texel, caster);
        const bool hidden = nearest * farthest * (1 + 0x1p-16) < 1;
        return !hidden && may_store(plane(texel, caster), texel, caster);
    };
    // Distances are compared as they are stored, so that window depth's roundings do not count.
    const auto nearest_at_texel = [&](std::uint32_t caster) {
        const PlaneAtPixel at = plane(texel, caster);
        return at.key() + (model().value == MapValue::depth ? at.error() : at.error_of_place());
    };
    // What clipping draws beside the caster's plane has some depth between its corners'.
    const auto nearest_corner = [&](std::uint32_t caster) {
        double nearest = nearest_at_texel(caster);
        for (const PicturePoint& point : pictured(texel.face, caster))
            nearest = std::max(nearest, point.key + point.depth_error);
        return nearest;
    };
    const double reach_of_ray = spread(around);
    const std::vector<std::uint32_t> casters =
        grid(texel.face).around({texel.x + 0.5, texel.y + 0.5}, reach);
    for (const std::uint32_t caster : casters)
        if (may_cover(scene, caster, centre, reach_of_ray) &&
            may_show(caster, nearest_at_texel(caster)))
            return of_scene_[caster];
    for (const std::uint32_t caster : casters)
        if (clipping_may_draw(texel, caster, reach) && may_show(caster, nearest_corner(caster)))
            return of_scene_[caster];
    return std::nullopt;
}

} // namespace shadowproof
