// The normals by which renderers may shade a surface: nothing in a picture says which they took.
#pragma once

#include "scenes/scene.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace shadowproof {

enum class NormalsBy : std::uint8_t {
    faces,    ///< flat: each triangle's own
    vertices, ///< the file's; without them, the mean of the triangles at a vertex by their angles
    areas,    ///< the mean of the triangles at a vertex by their areas
    bumps,    ///< by vertices, and as a bump map perturbs them
};
inline constexpr std::array all_normals_by{NormalsBy::faces, NormalsBy::vertices, NormalsBy::areas,
                                           NormalsBy::bumps};

/// Of some triangles of a scene, to which it keeps a reference.
class ShadingNormals {
public:
    /// `triangles`: those of which normals are asked, in growing order.
    ShadingNormals(const Scene& scene, std::vector<std::uint32_t> triangles);

    /// At a point of a triangle, towards its front, without bumps; of any length, none where it has
    /// no area.
    glm::dvec3 at(NormalsBy by, std::uint32_t triangle, const glm::dvec3& point) const;

private:
    using Corners = std::array<glm::vec3, 3>;

    const Scene& scene_;
    std::vector<std::uint32_t> triangles_;
    std::array<std::vector<Corners>, 2> corners_; ///< of each triangle, by vertices and by areas
};

} // namespace shadowproof
