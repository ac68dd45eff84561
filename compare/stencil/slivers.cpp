#include "compare/stencil/slivers.h"

#include "compare/stencil/figures/drawn_picture.h"

#include <algorithm>
#include <numbers>

namespace shadowproof {

namespace {

using Triangle = std::array<PicturePoint, 3>;

/// Where corners may be drawn further aside than snapping moves them, the face is coarse, and
/// judged as such (coarse_counts).
bool is_fine(const Triangle& part, double half_step) {
    return std::ranges::all_of(
        part, [&](const PicturePoint& corner) { return corner.place_error <= half_step; });
}

} // namespace

// The two triangles of a side do not overlap, or have opposite signs, wherever they are drawn: with
// one of them counted and the other not, it still counts once.
std::vector<Slivers::Sliver> Slivers::find() const {
    const DrawnFaces drawn =
        drawn_faces(volumes_, frame_.counted->counting, frame_.counted->volume_faces);
    const Scene& casters = volumes_.drawn_casters();
    const DrawnPicture picture{casters, volumes_.far_ends(), drawn, frame_, far_};
    const PicturedFaces pictured(picture);
    const PictureMaking making = making_of(picture);
    std::vector<Sliver> found;
    const auto add_parts = [&](const std::vector<Triangle>& parts, const auto& is_sliver,
                               Sliver& sliver) {
        for (const Triangle& part : parts)
            if (is_fine(part, making.half_step) && is_sliver(part)) sliver.parts.push_back(part);
    };
    Sliver sliver{&Number::sides};
    for (std::size_t i = 0; i < drawn.faces.size(); ++i) {
        const DrawnFace& face = drawn.faces[i];
        const bool is_second_of_side = face.other_corner && !face.first_of_side;
        if (!is_second_of_side)
            sliver = {face.part == DrawnFace::Part::side ? &Number::sides : &Number::caps,
                      face.copies};
        const bool is_surface =
            face.part == DrawnFace::Part::light_cap && face.triangle < scene_.triangles.size();
        if (!is_surface)
            add_parts(set_up(casters.camera, pictured.corners(i), making.drawing), may_have_no_area,
                      sliver);
        const bool is_whole = !face.other_corner || is_second_of_side;
        if (is_whole && !sliver.parts.empty()) found.push_back(std::move(sliver));
    }
    // What is cut in doubles is closed, and its slivers are faces like others.
    if (frame_.counted->volume_faces.near_plane != NearPlane::from_light) return found;
    const Drawing drawing = drawing_of_layers(making.drawing);
    for (const NearLayer& layer : drawn.near_layers) {
        const auto corners = pictured.corners(layer, PlaneCut::nominal);
        if (!corners) continue;
        sliver = {&Number::layers};
        add_parts(
            fan_of(clipped_polygon(casters.camera, *corners, drawing, PlaneCut::nominal)),
            [&](const Triangle& part) { return may_be_flipped(part, making.half_step); }, sliver);
        if (!sliver.parts.empty()) found.push_back(std::move(sliver));
    }
    return found;
}

Slivers::Number Slivers::at(const CoveredPixel& pixel) const {
    std::call_once(found_, [&] { slivers_ = find(); });
    Number number;
    if (slivers_.empty()) return number;
    const glm::dvec2 place = place_of(scene_.camera, pixel.line);
    for (const Sliver& sliver : slivers_)
        if (std::ranges::any_of(sliver.parts, [&](const Triangle& part) {
                return may_hold({part.begin(), part.end()}, place,
                                std::numbers::sqrt2 * pixel.reach);
            }))
            number.*sliver.kind += sliver.copies;
    return number;
}

} // namespace shadowproof
