#include "compare/driver/cut_surfaces.h"

#include "compare/driver/error_bounds.h"
#include "compare/driver/setup_error.h"
#include "reference/parallel.h"
#include "reference/trace/faces.h"
#include "scenes/driver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

namespace shadowproof {

namespace {

constexpr double v = float_roundoff;

std::array<ViewCorner, 3> viewed(const Scene& scene, std::uint32_t triangle,
                                 const Drawing& drawing) {
    std::array<ViewCorner, 3> corners;
    for (int k = 0; k < 3; ++k)
        corners[static_cast<std::size_t>(k)] =
            viewed(scene.camera, glm::dvec4(corner(scene, triangle, k), 1), drawing);
    return corners;
}

/// Whether a part of the triangle lies between two depths in the picture, or next to it.
bool passes_slab(const Camera& camera, const std::array<ViewCorner, 3>& corners,
                 const Drawing& drawing, double nearest, double furthest) {
    std::vector<ViewCorner> polygon(corners.begin(), corners.end());
    const auto clip = [&](const ClipFunction& function) {
        if (!polygon.empty()) polygon = clipped(polygon, function, drawing);
    };
    clip([&](const ViewCorner& c) { return c.at.z - nearest; });
    clip([&](const ViewCorner& c) { return furthest - c.at.z; });
    const glm::dvec2 reach = 2.0 * half_extent(camera); // far beyond all neighbourhoods
    for (const int axis : {0, 1})
        for (const double side : {-1.0, 1.0})
            clip([&](const ViewCorner& c) {
                return side * c.at[axis] + reach[axis] * (camera.is_orthographic() ? 1 : c.at.z);
            });
    return !polygon.empty();
}

} // namespace

// A triangle's depth less the plane's is linear over it, and floats make it wrong by no more
// anywhere than at the corner where it is most wrong. The corners that are made at the plane are
// off by three roundings of the larger of two.
ClipErrors clip_errors(const Scene& scene, std::uint32_t triangle, const Drawing& drawing) {
    const bool clips_near =
        scene.camera.is_orthographic() ? std::isfinite(drawing.near) : drawing.near > 0;
    ClipErrors errors;
    for (const ViewCorner& corner : viewed(scene, triangle, drawing)) {
        const double made = 3 * v * std::abs(corner.at.z);
        if (clips_near) errors.near = std::max(errors.near, near_error(corner, drawing) + made);
        if (std::isfinite(drawing.far))
            errors.far = std::max(errors.far, far_error(corner, drawing) + made);
    }
    return errors;
}

// In perspective it is the inverse of what set-up makes of 1 / w, and the plane's depth is rounded,
// too. Elsewhere it is what window depth is made of.
double fragment_error(const DepthPicture& picture, std::uint32_t triangle, const PlaneAtPixel& at) {
    const Scene& scene = picture.scene;
    const CoveredPixel pixel{at.line(), at.lateral(), picture.drawing};
    if (scene.camera.is_orthographic())
        return setup_error(scene, triangle, pixel) +
               0.5 * stored_depth_error(picture.model, at.depth());
    return inverse_w_error(scene, triangle, pixel) + 2 * v * std::abs(at.key());
}

namespace {

/// The largest fragment_error of a triangle at a plane, wherever it is drawn, as view depth.
double depth_of_key_error(const DepthPicture& picture, std::uint32_t triangle, double depth) {
    const Scene& scene = picture.scene;
    const bool is_parallel = scene.camera.is_orthographic();
    const auto at = [&](int k) { return glm::dvec4(corner(scene, triangle, k), 1); };
    std::vector<std::array<PicturePoint, 3>> parts =
        set_up(scene.camera, {at(0), at(1), at(2)}, picture.drawing);
    if (!is_parallel) parts = with_inverse_w(std::move(parts));
    double error = 0;
    for (const std::array<PicturePoint, 3>& part : parts) {
        double aside = picture.snapped_by;
        for (const PicturePoint& point : part)
            aside = std::max(aside, picture.snapped_by + point.place_error);
        error = std::max(error, largest_setup_error(part, aside));
    }
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (!(error < infinity)) return infinity;
    if (is_parallel) return error + 0.5 * stored_depth_error(picture.model, depth);
    const double least = 1 / depth - error - 2 * v / depth; // key
    return least > 0 ? 1 / least - depth : infinity;
}

} // namespace

CutSurfaces::CutSurfaces(const Tracer& tracer, const DepthModel& model, double far)
    : tracer_(tracer),
      picture_(
          depth_picture(tracer.scene(), model,
                        drawing_of(tracer.scene(), model,
                                   model.clips_at_far() ? tracer.scene().camera.far
                                                        : std::numeric_limits<double>::infinity()),
                        far)),
      near_{.depth = tracer.scene().camera.near, .clips = !model.clamp},
      far_{.depth = tracer.scene().camera.far, .clips = model.clips_at_far()} {
    const Scene& scene = tracer.scene();
    constexpr std::size_t together = 4096;
    std::vector<std::pair<Plane, Plane>> found((scene.triangles.size() + together - 1) / together,
                                               {near_, far_});
    parallel_for_all(
        scene.triangles.size(), tracer.threads(),
        [&](std::size_t i) {
            const auto triangle = static_cast<std::uint32_t>(i);
            auto& [at_near, at_far] = found[i / together];
            if (!sides_of(tracer, triangle).visible) return;
            find(triangle, at_near, &ClipErrors::near);
            find(triangle, at_far, &ClipErrors::far);
        },
        together);
    for (const auto& [at_near, at_far] : found) {
        std::ranges::copy(at_near.surfaces, std::back_inserter(near_.surfaces));
        std::ranges::copy(at_far.surfaces, std::back_inserter(far_.surfaces));
    }
}

/// Whether a triangle passes within more than all errors of its corners of a plane that clips:
/// quickly told, of the few that do.
bool CutSurfaces::may_reach(const Plane& plane, std::uint32_t triangle) const {
    const Camera& camera = tracer_.scene().camera;
    const Drawing& drawing = picture_.drawing;
    double nearest = std::numeric_limits<double>::infinity();
    double furthest = -nearest;
    double size = 0;
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 place = corner(tracer_.scene(), triangle, k);
        const double depth = view_depth(camera, place);
        nearest = std::min(nearest, depth);
        furthest = std::max(furthest, depth);
        size = std::max(size, glm::length(place));
    }
    const double n = drawing.standard_near;
    const double times = n > 0 && std::isfinite(drawing.far) ? std::max(drawing.far / n, 1.0) : 1;
    const double scale = size + glm::length(camera.eye) + drawing.parallel_far + plane.depth;
    const double error = times * 32 * v * scale;
    return nearest <= plane.depth + error && furthest >= plane.depth - error;
}

void CutSurfaces::find(std::uint32_t triangle, Plane& plane, double ClipErrors::*side) const {
    const Scene& scene = tracer_.scene();
    if (!std::isfinite(plane.depth) || (plane.clips && !may_reach(plane, triangle))) return;
    const double error = plane.clips ? clip_errors(scene, triangle, picture_.drawing).*side : 0;
    const double reach = plane.clips ? error : depth_of_key_error(picture_, triangle, plane.depth);
    if (passes_slab(scene.camera, viewed(scene, triangle, picture_.drawing), picture_.drawing,
                    plane.depth - reach, plane.depth + reach))
        plane.surfaces.push_back({triangle, error, plane_before_eye(scene, triangle)});
}

std::vector<CutSurfaces::Met> CutSurfaces::met(const Plane& plane, const glm::dvec3& line) const {
    const Scene& scene = tracer_.scene();
    const bool is_parallel = scene.camera.is_orthographic();
    const double key = is_parallel ? plane.depth : 1 / plane.depth;
    std::vector<Met> found;
    for (const Surface& surface : plane.surfaces) {
        if (!may_cover(scene, surface.triangle, line, 0)) continue;
        const double depth = depth_on_triangle(scene, surface.triangle, line);
        if (!std::isfinite(depth) || (!is_parallel && !(depth > 0))) continue;
        const double beyond = depth - plane.depth;
        const auto is_fragment_open = [&] {
            const PlaneAtPixel at(picture_, surface.triangle, surface.plane, line);
            return at.has_depth() &&
                   std::abs(at.key() - key) <= fragment_error(picture_, surface.triangle, at);
        };
        const bool is_open = plane.clips ? std::abs(beyond) <= surface.error : is_fragment_open();
        found.push_back({surface.triangle, beyond, is_open});
    }
    return found;
}

std::vector<CutSurfaces::OpenRay>
CutSurfaces::open_rays(std::span<const Neighbourhood> around) const {
    const auto is_open = [](const Met& met) { return met.is_open; };
    std::vector<std::vector<OpenRay>> of_each(around.size());
    parallel_for(static_cast<int>(around.size()), tracer_.threads(), [&](int number, int) {
        const auto i = static_cast<std::size_t>(number);
        for (std::size_t k = 0; k < around[i].rays.size(); ++k) {
            const glm::dvec3& line = around[i].rays[k];
            OpenRay ray{i, k, met(near_, line), met(far_, line)};
            if (std::ranges::any_of(ray.near, is_open) || std::ranges::any_of(ray.far, is_open))
                of_each[i].push_back(std::move(ray));
        }
    });
    std::vector<OpenRay> open;
    for (std::vector<OpenRay>& own : of_each) std::ranges::move(own, std::back_inserter(open));
    return open;
}

/// Whether a surface that is seen between moved planes may be seen: all that lies between these and
/// the planes themselves, before it, may be cut or not.
bool CutSurfaces::may_see(const OpenRay& ray, const SeenRange& moved, const RayTruth& truth) const {
    const auto is_as_told = [&](const Plane& plane, const Met& met, bool was, bool is) {
        const double depth = plane.depth + met.beyond;
        return met.is_open || was == is || depth > truth.depth;
    };
    return std::ranges::all_of(ray.near,
                               [&](const Met& met) {
                                   return is_as_told(near_, met, met.beyond >= 0,
                                                     near_.depth + met.beyond >= moved.near);
                               }) &&
           std::ranges::all_of(ray.far, [&](const Met& met) {
               return is_as_told(far_, met, met.beyond <= 0, far_.depth + met.beyond <= moved.far);
           });
}

/// How far the open surfaces lie from a plane, at most.
std::optional<double> CutSurfaces::reach_of_open(std::span<const OpenRay> rays,
                                                 std::vector<Met> OpenRay::*side) {
    std::optional<double> most;
    for (const OpenRay& ray : rays)
        for (const Met& met : ray.*side)
            if (met.is_open) most = std::max(most.value_or(0), std::abs(met.beyond));
    return most;
}

/// The planes moved so that they leave out none of the open surfaces, or all.
std::vector<SeenRange> CutSurfaces::moved_planes(std::span<const OpenRay> rays) const {
    const bool is_parallel = tracer_.scene().camera.is_orthographic();
    const auto depths = [&](const Plane& plane, const std::optional<double>& reach) {
        if (!reach) return std::vector<double>{plane.depth};
        // Than which depths here are better.
        const double by = *reach + 0x1p-45 * (plane.depth + picture_.drawing.parallel_far);
        const double ahead =
            is_parallel ? plane.depth - by : std::max(plane.depth - by, 0x1p-20 * plane.depth);
        return std::vector<double>{ahead, plane.depth + by};
    };
    std::vector<SeenRange> moved;
    for (const double near : depths(near_, reach_of_open(rays, &OpenRay::near)))
        for (const double far : depths(far_, reach_of_open(rays, &OpenRay::far)))
            if (near < far) moved.push_back({near, far});
    return moved;
}

std::vector<RayTruth> CutSurfaces::look_aside(std::span<Neighbourhood> around,
                                              std::vector<RayTruth> truths,
                                              const MaskErrors* masks) const {
    if (empty()) return truths;
    const std::vector<OpenRay> open = open_rays(around);
    if (open.empty()) return truths;
    std::vector<glm::dvec3> lines;
    std::vector<MaskReading> readings;
    for (const OpenRay& ray : open) {
        const Neighbourhood& own = around[ray.neighbourhood];
        lines.push_back(own.rays[ray.ray]);
        if (!own.readings.empty()) readings.push_back(own.readings[ray.ray]);
    }
    std::vector<std::vector<RayTruth>> added(around.size());
    std::vector<std::vector<std::uint32_t>> seen(open.size()); // along each
    std::vector<std::size_t> first(1, 0); // of each neighbourhood's truths among all
    for (const Neighbourhood& each : around) first.push_back(first.back() + each.rays.size());
    for (std::size_t k = 0; k < open.size(); ++k)
        seen[k] = {truths[first[open[k].neighbourhood] + open[k].ray].triangle};
    for (const SeenRange& moved : moved_planes(open)) {
        const std::vector<RayTruth> found = trace_rays(tracer_, lines, {readings, masks}, moved);
        for (std::size_t k = 0; k < open.size(); ++k) {
            if (std::ranges::find(seen[k], found[k].triangle) != seen[k].end() ||
                !may_see(open[k], moved, found[k]))
                continue;
            seen[k].push_back(found[k].triangle);
            Neighbourhood& own = around[open[k].neighbourhood];
            own.rays.push_back(lines[k]);
            if (!own.readings.empty()) own.readings.push_back(readings[k]);
            own.moved.push_back(moved);
            added[open[k].neighbourhood].push_back(found[k]);
        }
    }
    std::vector<RayTruth> all;
    for (std::size_t i = 0; i < around.size(); ++i) {
        const std::span own = std::span(truths).subspan(first[i], first[i + 1] - first[i]);
        all.insert(all.end(), own.begin(), own.end());
        all.insert(all.end(), added[i].begin(), added[i].end());
    }
    return all;
}

} // namespace shadowproof
