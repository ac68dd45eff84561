// How other engines describe a camera: axes, handedness, units, field of view, depth range. glTF's
// vertices are placed as the engine's usual importer places them.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <string_view>

namespace shadowproof {

/// Depth in normalized device coordinates, from the near plane to the far plane.
enum class NdcDepth : std::uint8_t { minus_one_to_one, zero_to_one, one_to_zero };

struct Convention {
    std::string_view name;   ///< for --engine: "three"
    std::string_view engine; ///< "three.js"
    std::string_view axes;   ///< of its world, in words
    /// From glTF's world axes to the engine's, without scaling: orthogonal, and mirroring where the
    /// engine is left-handed.
    glm::dmat3 world_from_gltf{1};
    double units = 1; ///< engine units per glTF unit (a metre)
    /// The camera's right, up and forward directions, as columns, in the axes of its node and in
    /// those of its view matrix; the two may differ.
    glm::dmat3 node_axes{1};
    glm::dmat3 view_axes{1};
    bool horizontal_field_of_view = false; ///< else vertical
    NdcDepth depth_range = NdcDepth::minus_one_to_one;
    bool infinite_far = false; ///< its cameras can do without a far plane
};

/// three.js, Babylon, Godot, Blender, OGRE, Unity and Unreal.
const std::array<Convention, 7>& conventions();

} // namespace shadowproof
