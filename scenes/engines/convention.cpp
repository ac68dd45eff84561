#include "scenes/engines/convention.h"

namespace shadowproof {

namespace {

using Columns = glm::dmat3;

/// Right, up, forward of a camera that looks down its -z with its y up: OpenGL's.
constexpr Columns looks_down_minus_z{1, 0, 0, 0, 1, 0, 0, 0, -1};
/// Of one that looks down its +z with its y up: Direct3D's.
constexpr Columns looks_down_z{1, 0, 0, 0, 1, 0, 0, 0, 1};
/// Of one that looks along its x with its z up; y is to its right.
constexpr Columns looks_down_x{0, 1, 0, 0, 0, 1, 1, 0, 0};

constexpr Columns as_gltf{1};
/// (x, y, z) -> (-x, y, z). glTF's cameras look down -z, these engines' look down +z: mirroring x
/// rather than z keeps a model's front, +z in glTF, where it is.
constexpr Columns mirrored_x{-1, 0, 0, 0, 1, 0, 0, 0, 1};
/// (x, y, z) -> (x, -z, y): a quarter turn about x brings y up to z up.
constexpr Columns z_up{1, 0, 0, 0, 0, 1, 0, -1, 0};
/// (x, y, z) -> (x, z, y): exchanging two axes mirrors and brings y up to z up.
constexpr Columns exchanged{1, 0, 0, 0, 0, 1, 0, 1, 0};

} // namespace

const std::array<Convention, 7>& conventions() {
    static const std::array<Convention, 7> all{{
        // GLTFLoader keeps the file's axes. PerspectiveCamera: vertical, degrees; its projection
        // has OpenGL's depths, and needs a far plane.
        {.name = "three",
         .engine = "three.js",
         .axes = "right-handed, y up; cameras look down -z",
         .world_from_gltf = as_gltf,
         .node_axes = looks_down_minus_z,
         .view_axes = looks_down_minus_z},
        // The glTF loader's __root__ turns by half about y and mirrors z: together x is mirrored.
        // FreeCamera: vertical (FOVMODE_VERTICAL_FIXED), radians; OpenGL's depths under WebGL.
        {.name = "babylon",
         .engine = "Babylon.js",
         .axes = "left-handed, y up; cameras look down +z",
         .world_from_gltf = mirrored_x,
         .node_axes = looks_down_z,
         .view_axes = looks_down_z},
        // Keeps the file's axes. Camera3D: vertical (KEEP_HEIGHT), degrees; get_camera_projection
        // has OpenGL's depths.
        {.name = "godot",
         .engine = "Godot 4",
         .axes = "right-handed, y up; cameras look down -z",
         .world_from_gltf = as_gltf,
         .node_axes = looks_down_minus_z,
         .view_axes = looks_down_minus_z},
        // The importer turns y up to z up, cameras look down their -z. calc_matrix_camera has
        // OpenGL's depths.
        {.name = "blender",
         .engine = "Blender",
         .axes = "right-handed, z up; cameras look down their -z",
         .world_from_gltf = z_up,
         .node_axes = looks_down_minus_z,
         .view_axes = looks_down_minus_z},
        // Keeps the file's axes. setFOVy: vertical; getProjectionMatrix has OpenGL's depths, and
        // a far distance of 0 means none.
        {.name = "ogre",
         .engine = "OGRE",
         .axes = "right-handed, y up; cameras look down -z",
         .world_from_gltf = as_gltf,
         .node_axes = looks_down_minus_z,
         .view_axes = looks_down_minus_z,
         .infinite_far = true},
        // glTFast and UnityGLTF mirror x. Transforms look down +z, worldToCameraMatrix down -z, and
        // projectionMatrix has OpenGL's depths on every platform. fieldOfView: vertical, degrees.
        {.name = "unity",
         .engine = "Unity",
         .axes = "left-handed, y up; cameras look down +z",
         .world_from_gltf = mirrored_x,
         .node_axes = looks_down_z,
         .view_axes = looks_down_minus_z},
        // The importer exchanges y and z, in centimetres. Actors look along their x; the view
        // matrix has x right, y up, z forward, and depths are 1 at the near plane, 0 at infinity.
        // FieldOfView: horizontal, degrees.
        {.name = "unreal",
         .engine = "Unreal Engine",
         .axes = "left-handed, z up, centimetres; cameras look along +x",
         .world_from_gltf = exchanged,
         .units = 100,
         .node_axes = looks_down_x,
         .view_axes = looks_down_z,
         .horizontal_field_of_view = true,
         .depth_range = NdcDepth::one_to_zero,
         .infinite_far = true},
    }};
    return all;
}

} // namespace shadowproof
