// How other engines write a camera down: axes, handedness, units, field of view, depth range.
// Where a glTF file's vertices go is what the engine's usual importer does.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <string_view>

namespace shadowproof {

/// Window or clip depth from the near plane to the far one, over w.
enum class DepthRange : std::uint8_t { minus_one_to_one, zero_to_one, one_to_zero };

struct Convention {
    std::string_view name;   ///< for --engine: "three"
    std::string_view engine; ///< "three.js"
    std::string_view axes;   ///< of its world, in words
    /// glTF's world axes to the engine's, without lengths: orthogonal, mirroring where the engine
    /// is left-handed.
    glm::dmat3 world_from_gltf{1};
    double units = 1; ///< engine units in one of glTF's, a metre
    /// What the camera's own axes are: right, up and forward in them, as columns. Of its node, and
    /// of its view matrix, which may differ.
    glm::dmat3 node_axes{1};
    glm::dmat3 view_axes{1};
    bool horizontal_field_of_view = false; ///< else vertical
    DepthRange depth_range = DepthRange::minus_one_to_one;
    bool infinite_far = false; ///< its cameras can do without a far plane
};

/// three.js, Babylon, Godot, Blender, OGRE, Unity and Unreal.
const std::array<Convention, 7>& conventions();

} // namespace shadowproof
