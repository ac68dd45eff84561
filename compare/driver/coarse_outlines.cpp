#include "compare/driver/coarse_outlines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace shadowproof {

namespace {

double furthest_aside(const PicturePoint& from, const PicturePoint& to) {
    return std::max(from.place_error, to.place_error);
}

std::vector<PicturePoint> clipped_triangle(const Scene& scene, std::uint32_t triangle,
                                           const Drawing& drawing) {
    const auto at = [&](int k) { return glm::dvec4(corner(scene, triangle, k), 1); };
    return clipped_polygon(scene.camera, {at(0), at(1), at(2)}, drawing);
}

} // namespace

// Corners that no clipping made are off by less than the reach: what those displace, the pixel's
// neighbourhood shows.
bool may_be_displaced(const Scene& scene, std::uint32_t triangle, const CoveredPixel& pixel) {
    const std::vector<PicturePoint> polygon = clipped_triangle(scene, triangle, pixel.drawing);
    const bool is_coarse = std::ranges::any_of(polygon, [&](const PicturePoint& corner) {
        return corner.made_by_clipping && !(corner.place_error <= pixel.reach);
    });
    const glm::dvec2 place = place_of(scene.camera, pixel.line);
    return is_coarse && !certainly_holds(polygon, place, pixel.reach);
}

CoarseOutlines::CoarseOutlines(const Scene& scene, const Silhouette* silhouette,
                               const std::vector<glm::vec3>* far_ends, const Drawing& drawing) {
    for (std::uint32_t triangle = 0; triangle < scene.triangles.size(); ++triangle)
        add(clipped_triangle(scene, triangle, drawing));
    if (silhouette != nullptr) add_volumes(scene, *silhouette, far_ends, drawing);
    std::stable_sort(outlines_.begin(), outlines_.end(), [](const Outline& a, const Outline& b) {
        return furthest_aside(a.from, a.to) > furthest_aside(b.from, b.to);
    });
}

/// The diagonal between a side's two triangles is no outline, but both triangles are clipped.
void CoarseOutlines::add_volumes(const Scene& scene, const Silhouette& silhouette,
                                 const std::vector<glm::vec3>* far_ends, const Drawing& drawing) {
    for (const Silhouette::Side& side : silhouette.sides())
        if (side.triangle != no_triangle)
            for (const std::array<glm::dvec4, 3>& half :
                 triangles_of_side(scene, far_ends, side.triangle, static_cast<int>(side.part)))
                add(clipped_polygon(scene.camera, half, drawing));
}

void CoarseOutlines::add(const std::vector<PicturePoint>& polygon) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const PicturePoint& from = polygon[i];
        const PicturePoint& to = polygon[(i + 1) % polygon.size()];
        // A corner in the eye itself has no place in the picture.
        if (!std::isfinite(furthest_aside(from, to))) continue;
        if (from.made_by_clipping || to.made_by_clipping) outlines_.push_back({from, to});
    }
}

std::optional<CoarseOutlines::NearPlace>
CoarseOutlines::near(const Outline& outline, const glm::dvec2& place, double step) {
    const auto& [from, to] = outline;
    const glm::dvec2 along = to.place - from.place;
    const double length = glm::length(along);
    if (!(length > 0)) return std::nullopt;
    const double t = std::clamp(glm::dot(place - from.place, along) / (length * length), 0.0, 1.0);
    const glm::dvec2 nearest = from.place + t * along;
    const double aside = (1 - t) * from.place_error + t * to.place_error;
    if (glm::length(nearest - place) > aside + step) return std::nullopt;
    return NearPlace{nearest, along / length, aside};
}

bool CoarseOutlines::may_reach(const glm::dvec2& place, double step) const {
    return std::ranges::any_of(outlines_, [&](const Outline& outline) {
        const std::optional<NearPlace> found = near(outline, place, step);
        return found && found->aside > step;
    });
}

std::vector<glm::dvec2> CoarseOutlines::places_across(const glm::dvec2& place, double step,
                                                      std::size_t most) const {
    std::vector<glm::dvec2> places;
    for (const Outline& outline : outlines_) {
        if (places.size() >= most) break;
        const std::optional<NearPlace> found = near(outline, place, step);
        if (!found) continue;
        const glm::dvec2 across = step * glm::dvec2(-found->along.y, found->along.x);
        places.push_back(found->nearest + across);
        places.push_back(found->nearest - across);
    }
    return places;
}

} // namespace shadowproof
