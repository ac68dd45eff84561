// The faces that a technique draws as the volumes of its casters, derived independently of its code
// from its declared way of counting and the definition of a shadow volume.
#pragma once

#include "reference/predict/volumes.h"
#include "scenes/frame.h"
#include "scenes/scene.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace shadowproof {

/// A triangle of a volume's boundary. With n positions in the casters' scene, corner i < n is
/// position i, corner i + n the same at the volume's far end, and corner i + 2n the far end along
/// DrawnFaces::far_points[i].
struct DrawnFace {
    enum class Part : std::uint8_t { side, light_cap, dark_cap };
    Part part = Part::side;
    bool certain = true;        ///< false if the shader's rounding may put the light on either side
    std::uint32_t triangle = 0; ///< of the casters: whose cap it is, or whose edge a side stands on
    glm::uvec3 corners{0, 0, 0};
    /// For a side, which is drawn as two triangles that share an edge: the corner that only the
    /// other one has.
    std::optional<std::uint32_t> other_corner;
    bool first_of_side = false;
    bool inward = false; ///< its corners run clockwise as seen from outside the volume
    /// How often it is drawn: a side with a surplus, or the caps of so many triangles with the same
    /// corners, of which `triangle` is the first and the others follow it.
    std::uint32_t copies = 1;
};

/// What is drawn where a triangle's volume meets the near plane.
struct NearLayer {
    std::uint32_t triangle = 0; ///< of the casters
    bool touches_light = false; ///< its volume has far ends that are split
};

struct DrawnFaces {
    std::vector<DrawnFace> faces;
    /// Where casters touch the light: see scenes/mesh/split_far_ends.h.
    std::vector<glm::vec3> far_points;
    /// Triangles of the casters, facing the light, whose volumes are drawn where they meet the near
    /// plane: in front of everything.
    std::vector<NearLayer> near_layers;
};

/// `volumes`: those of `counting`. Time is O(n log n) in their casters' triangles.
DrawnFaces drawn_faces(const Volumes& volumes, const Counting& counting, const VolumeFaces& drawn);

} // namespace shadowproof
