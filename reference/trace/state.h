// The state of a Tracer: the scene, prepared for the queries of reference/.
#pragma once

#include "reference/exact/mask_sign.h"
#include "reference/exact/predicates.h"
#include "reference/trace/places.h"
#include "reference/trace/shells.h"
#include "reference/trace/trace.h"
#include "reference/trace/view.h"
#include "reference/walk/box_trees.h"
#include "scenes/surface/alpha_mask.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace shadowproof {

/// What is asked of every triangle that is seen, as bits.
enum Facing : std::uint8_t {
    faces_light_bit = 1, ///< eye and light are strictly on the same side of it
    edge_on_bit = 2,     ///< the light lies in its plane
    receives_bit = 4,    ///< it receives shadows
    copied_bit = 8,      ///< others have the same corners
};

struct Tracer::State {
    const Scene* scene = nullptr;
    int threads = 1;
    Predicates predicates;
    Places places;
    Clusters clusters; ///< of the first triangle of each place
    std::optional<BoxTrees> trees;
    OriginView from_eye;
    OriginView from_light;                  ///< its `side` is 0 for triangles that do not cast
    std::vector<std::int8_t> side_of_light; ///< as OriginView::side, but of all triangles
    std::vector<std::uint8_t> double_sided; ///< one flag per triangle
    std::vector<std::uint8_t> receives;     ///< one flag per triangle
    std::vector<std::uint8_t> facing;       ///< bits of Facing, per triangle
    std::vector<std::uint32_t> masks;       ///< masks_of_triangles
    glm::dvec4 eye{0, 0, 0, 1};             ///< homogeneous_eye
    glm::dvec4 light{0, 0, 0, 1};           ///< homogeneous
    std::optional<Cone> cone;               ///< of a spot light
    LazyShells shells;                      ///< of the casters
    double build_milliseconds = 0;

    /// A line of sight (camera.h), as the predicates take it.
    EyeRay ray(const glm::dvec3& line) const {
        return {start_of(scene->camera, line), direction_of(scene->camera, line), light};
    }

    bool has_mask(std::uint32_t triangle) const {
        return !masks.empty() && masks[triangle] != no_mask;
    }
    /// Of a triangle that has a mask.
    MaskedTriangle masked(std::uint32_t triangle) const {
        return {corners(*scene, triangle), mask_coordinates(*scene, triangle),
                &scene->masks[masks[triangle]]};
    }

    /// Whether eye and light are strictly on the same side of the triangle.
    bool faces_light(std::uint32_t triangle) const {
        return (facing[triangle] & faces_light_bit) != 0;
    }
};

} // namespace shadowproof
