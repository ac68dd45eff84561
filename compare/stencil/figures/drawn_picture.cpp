#include "compare/stencil/figures/drawn_picture.h"

#include "compare/stencil/figures/near_layers.h"
#include "scenes/driver.h"
#include "scenes/mesh/touching_light.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace shadowproof {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

PicturedFace pictured_anywhere() {
    PicturedFace face;
    face.possible = ConvexRegion::everywhere();
    face.margin = infinity;
    face.in_front = true;
    return face;
}

} // namespace

PictureMaking making_of(const DrawnPicture& picture) {
    const Frame& frame = picture.frame;
    const bool clips = frame.depth_model.clips_at_far();
    return {picture.casters.camera,
            drawing_of(picture.casters, frame.depth_model, clips ? picture.far : infinity),
            half_snapping_step(frame.depth_model.subpixel_bits)};
}

PicturedFaces::PicturedFaces(const DrawnPicture& picture)
    : picture_(picture), making_(making_of(picture)),
      light_(homogeneous(chosen_light(picture.casters))),
      light_in_near_plane_(is_in_near_plane(picture.casters)),
      casters_near_light_(!picture.faces.near_layers.empty() &&
                          casters_near_light(picture.casters)) {}

glm::dvec4 PicturedFaces::place(std::uint32_t corner) const {
    const std::vector<glm::vec3>& positions = picture_.casters.positions;
    if (corner < positions.size()) return {glm::dvec3(positions[corner]), 1};
    const std::size_t end = corner - positions.size();
    if (end >= positions.size())
        return at_infinity(picture_.faces.far_points[end - positions.size()]);
    if (picture_.far_ends != nullptr) return {glm::dvec3((*picture_.far_ends)[end]), 1};
    return at_infinity(positions[end]);
}

glm::dvec4 PicturedFaces::at_infinity(const glm::dvec3& point) const {
    return {light_.w * point - glm::dvec3(light_), 0};
}

std::array<glm::dvec4, 3> PicturedFaces::corners(std::size_t number) const {
    const glm::uvec3& corners = picture_.faces.faces[number].corners;
    return {place(corners.x), place(corners.y), place(corners.z)};
}

double PicturedFaces::margin_by_size(std::size_t number) const {
    return shadowproof::margin_by_size(making_, corners(number));
}

PicturedFace PicturedFaces::volume_face(const DrawnFace& drawn) const {
    const glm::dvec4 other = drawn.other_corner ? place(*drawn.other_corner) : glm::dvec4(0);
    PicturedFace face = pictured_face(
        making_, {place(drawn.corners.x), place(drawn.corners.y), place(drawn.corners.z)},
        drawn.other_corner ? &other : nullptr, glm::length(glm::dvec3(light_)));
    face.stands_for_both = !drawn.other_corner || drawn.first_of_side;
    face.copies = drawn.copies;
    if (drawn.inward) face.change = -face.change;
    if (drawn.part == DrawnFace::Part::light_cap) {
        face.light_cap_of = drawn.triangle;
        face.own_triangles = drawn.copies;
    }
    if (!drawn.certain) face.certain = face.certain_of_both = {};
    return face;
}

// The place of a layer is not predicted for a light in the near plane, nor for a caster that
// touches the light: there the counter, which is judged at every pixel, begins with what was
// drawn.
std::optional<std::vector<ViewCorner>> PicturedFaces::corners(const NearLayer& layer,
                                                              PlaneCut cut) const {
    const NearDrawing drawn{picture_.frame.counted->volume_faces.near_plane, casters_near_light_};
    const bool is_capped = drawn.near_plane == NearPlane::capped;
    if (light_in_near_plane_ || layer.touches_light ||
        (is_capped && is_flat_from_light(picture_.casters, layer.triangle)))
        return std::nullopt;
    return near_layer(picture_.casters, layer.triangle, drawn, cut);
}

PicturedFace PicturedFaces::layer(const NearLayer& layer) const {
    const auto most = corners(layer, PlaneCut::most);
    if (!most) return pictured_anywhere();
    return pictured_layer(making_, *most, *corners(layer, PlaneCut::least));
}

} // namespace shadowproof
