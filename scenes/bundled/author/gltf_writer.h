// Writes a stage (placed shapes, one camera, lights) as the text of a .gltf with an embedded
// buffer. The same stage gives the same bytes.
#pragma once

#include "scenes/bundled/author/shapes.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <string>
#include <vector>

namespace shadowproof::author {

/// The material of a thing beside its colour; textures are indices into Stage::textures.
struct Look {
    std::optional<std::size_t> bump{};
    bool bump_is_height = false; ///< else it is a normal map
    double bump_scale = 1;
    bool height_in_space = false; ///< bump_scale is in units of the scene, else in texels
    std::optional<std::size_t> decal{};
    std::optional<double> cutoff{}; ///< of the decal's alpha: below it the surface is left out
    bool gloss_in_alpha = false;
    std::optional<glm::dvec3> specular{};
    std::optional<glm::dvec3> reflectance{};
};

/// How a morph target at weight 1 moves each vertex; of normals and tangents where the shape has
/// some.
struct Morph {
    std::vector<glm::dvec3> vertices;
    std::vector<glm::dvec3> normals;
    std::vector<glm::dvec3> tangents;
};

/// The joints that move a vertex, by index into Stage::joints, and how much each does; sum 1.
struct Influence {
    glm::uvec4 joints{0, 0, 0, 0};
    glm::dvec4 weights{1, 0, 0, 0};
};

struct Placed {
    std::string name;
    Shape shape;
    glm::dvec3 color{0.8, 0.8, 0.8}; ///< linear base colour
    glm::dvec3 position{0, 0, 0};
    glm::dvec3 turn_axis{0, 1, 0};
    double turn = 0; ///< radians about turn_axis
    bool double_sided = false;
    Look look{};
    std::vector<Morph> morphs{};
    std::vector<Influence> influences{}; ///< one per vertex: then only joints place the thing,
                                         ///< not `position` and `turn`
    std::optional<std::size_t> joint{};  ///< its parent: position and turn are relative to it
};

/// A node that moves skinned things and carries others. Shapes are modelled in the space of the
/// root joint, with no other joint rotated.
struct Joint {
    std::string name;
    std::optional<std::size_t> parent{}; ///< an earlier one; none: the root
    glm::dvec3 position{0, 0, 0};        ///< relative to the parent
    double turn = 0;                     ///< radians about y, of the root
};

/// Key frames of one property of a node, with linear interpolation.
struct Track {
    std::string node;
    std::string path;           ///< as glTF says it: "translation", "rotation", "weights"
    std::vector<float> times;   ///< seconds
    std::vector<double> values; ///< as many per key as the property has
};

// Wrap modes by their numbers in glTF.
inline constexpr int wrap_repeat = 10497;
inline constexpr int wrap_mirrored_repeat = 33648;
inline constexpr int wrap_clamp_to_edge = 33071;

struct Painting {
    std::string name;
    std::vector<std::uint8_t> png;
    int wrap = wrap_repeat; ///< both ways
    bool mipmaps = false;   ///< whether the file asks for them
};

struct Lamp {
    std::string name = "light";
    std::string type = "point"; ///< as KHR_lights_punctual says it
    glm::dvec3 position{0, 10, 0};
    glm::dvec3 target{0, 0, 0};         ///< where a spot or a directional light shines to
    glm::dvec3 color{1, 1, 1};          ///< linear
    double intensity = 2000;            ///< candela, or lux of a directional light
    double outer_cone = 0.785;          ///< of a spot, radians
    std::optional<double> range{};      ///< as KHR_lights_punctual has it
    std::optional<glm::dvec3> moves_to; ///< where it is after four seconds, along a straight line
};

struct Stage {
    std::string name;
    std::string title;                    ///< for asset.extras, one sentence
    std::vector<std::string> provokes;    ///< cause names
    std::vector<std::string> may_provoke; ///< in pictures wider than high, not in all
    std::vector<Placed> things;
    std::vector<Joint> joints{};
    std::vector<Track> tracks{};
    std::vector<Painting> textures{};
    glm::dvec3 ambient{0, 0, 0};
    bool inverse_square = false;            ///< the light's intensity and distance count
    std::vector<std::size_t> environment{}; ///< +x -x +y -y +z -z, indices into textures; or none
    glm::dvec3 eye{0, 0, 5};
    glm::dvec3 target{0, 0, 0};
    double yfov = 0.6; ///< radians
    double znear = 0.5;
    double zfar = 100;
    Lamp light;
    std::vector<Lamp> more_lights;
};

std::string write_gltf(const Stage& stage);

} // namespace shadowproof::author
