// All faces that a technique draws as volumes, as they appear in its picture.
#pragma once

#include "compare/driver/pictured_face.h"
#include "compare/stencil/figures/drawn_faces.h"
#include "scenes/frame.h"
#include "scenes/image.h"
#include "scenes/scene.h"

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

namespace shadowproof {

/// What is drawn, and how. `casters`: as counted_casters gives them; `far_ends`: where their
/// positions lie once extruded, null where that is at infinity; `far`: the far plane of techniques
/// that have a finite one.
struct DrawnPicture {
    const Scene& casters;
    const std::vector<glm::vec3>* far_ends = nullptr;
    const DrawnFaces& faces;
    const Frame& frame; ///< counting, depth model, near plane; depths and triangles for the order
    double far = 0;
};

PictureMaking making_of(const DrawnPicture& picture);

/// Prepares the faces by their number: those of volumes, then the layers.
class PicturedFaces {
public:
    /// Keeps references to all.
    explicit PicturedFaces(const DrawnPicture& picture);

    std::size_t count() const {
        return picture_.faces.faces.size() + picture_.faces.near_layers.size();
    }
    PicturedFace face(std::size_t number) const {
        const std::vector<DrawnFace>& faces = picture_.faces.faces;
        return number < faces.size() ? volume_face(faces[number])
                                     : layer(picture_.faces.near_layers[number - faces.size()]);
    }
    /// Homogeneous world points (p, w) of a volume's face.
    std::array<glm::dvec4, 3> corners(std::size_t number) const;
    /// What is left of a near plane's layer where that cuts; none if its place is not predicted.
    std::optional<std::vector<ViewCorner>> corners(const NearLayer& layer, PlaneCut cut) const;
    /// Of a volume's face: see driver/pictured_face.h.
    double margin_by_size(std::size_t number) const;

private:
    const DrawnPicture& picture_;
    PictureMaking making_;
    glm::dvec4 light_;
    bool light_in_near_plane_;
    bool casters_near_light_;

    glm::dvec4 place(std::uint32_t corner) const;
    glm::dvec4 at_infinity(const glm::dvec3& point) const;
    PicturedFace volume_face(const DrawnFace& drawn) const;
    PicturedFace layer(const NearLayer& layer) const;
};

} // namespace shadowproof
