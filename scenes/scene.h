// A scene as reference and rasterizer both see it: triangles baked once to world-space float32, one
// camera, one light chosen among the file's and, where a material has a bump map, what lighting
// needs of its surfaces. Plain data; references are indices.
#pragma once

#include "scenes/camera.h"
#include "scenes/cause.h"
#include "scenes/cube_map.h"
#include "scenes/texture.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace shadowproof {

inline constexpr std::uint32_t no_triangle = 0xffffffffU;
inline constexpr std::uint32_t no_texture = 0xffffffffU;
inline constexpr std::uint32_t no_mask = 0xffffffffU;

/// What perturbs a surface's normals.
enum class Bump : std::uint8_t {
    none,
    normal_map,   ///< glTF's normalTexture: x along the tangent, y along the bitangent, 0 at 0.5
    height_field, ///< red is the height, in units of Material::bump_scale
};

/// Colours are linear. All but the first three members are set only in scenes with bump maps
/// (is_bump_lit).
struct Material {
    std::string name;
    bool double_sided = false;    ///< otherwise a triangle is not seen from behind, as glTF says
    std::uint32_t mask = no_mask; ///< index into Scene::masks
    glm::dvec3 color{1, 1, 1};    ///< times the decal's
    glm::dvec3 specular{1, 1, 1};
    glm::dvec3 reflectance{0, 0, 0};  ///< times the environment; 0 where there is none
    std::uint32_t decal = no_texture; ///< index into Scene::textures
    bool gloss_in_alpha = false;      ///< the decal's alpha times the specular colour
    Bump bump = Bump::none;
    std::uint32_t bump_map = no_texture; ///< index into Scene::textures; none where bump is
    double bump_scale = 1;               ///< of a normal's x and y, or of a height
    bool height_in_space = false; ///< heights are in units of space, not texels, so that bumps are
                                  ///< less steep where a texel is stretched
};

/// A triangle's corner as lighting sees it, in world space, rounded once to float: the same array
/// goes to OpenGL.
struct Surface {
    glm::vec3 normal{0, 0, 1};     ///< unit, towards the front
    glm::vec4 tangent{0, 0, 0, 0}; ///< unit, w = +-1: bitangent = w * cross(normal, tangent), which
                                   ///< runs against the texture's rows; 0 without a bump map
    glm::vec2 decal_at{0, 0};      ///< texture coordinates (1, 1: the lower right corner)
    glm::vec2 bump_at{0, 0};
};

/// A run of triangles with one material: one glTF primitive of one node.
struct Mesh {
    std::string name; ///< for messages: node and mesh names, or their JSON pointer
    std::uint32_t first_triangle = 0;
    std::uint32_t triangle_count = 0;
    std::uint32_t material = 0; ///< index into Scene::materials
    bool casts = true;          ///< casts shadows
    bool receives = true;       ///< shows shadows: otherwise its lit sides are lit throughout
    bool textured = false;      ///< a texture, or colours of its vertices, may vary over it
};

struct Light {
    enum class Kind : std::uint8_t { point, spot, directional };
    std::string name;
    std::string choice{}; ///< what identifies it within the file: its name, else its number
    Kind kind = Kind::point;
    glm::dvec3 position{0, 0, 0};   ///< point and spot
    glm::dvec3 direction{0, 0, -1}; ///< spot and directional: where the light shines to, unit
    double inner_cone = 0;          ///< spot, radians
    double outer_cone = 0.7853981633974483; ///< spot, radians
    glm::dvec3 color{1, 1, 1};              ///< linear
    double intensity = 1;                   ///< candela, or lux where directional
    /// Beyond it a renderer may leave the light out to save time. Nothing physical ends there, and
    /// truth knows none; a shadow map's far plane lies there, as engines have it.
    double range = std::numeric_limits<double>::infinity();
};

constexpr std::string_view name_of(Light::Kind kind) {
    switch (kind) {
    case Light::Kind::point:
        return "point";
    case Light::Kind::spot:
        return "spot";
    case Light::Kind::directional:
        break;
    }
    return "directional";
}

/// (position, 1), or (direction to the light, 0) of a directional one: L = (l, w). The direction
/// from a point Q to the light is l - w Q.
glm::dvec4 homogeneous(const Light& light);

/// selfShadow(v) = clamp(8 v . N, 0, 1) of which vector dims the highlight. Kilgard's rule (2001,
/// The Required Per-Pixel Math) has the light's; the passes that he shows have others.
enum class HighlightShadow : std::uint8_t { light, half_angle, both, none };
inline constexpr std::array all_highlight_shadows{HighlightShadow::light,
                                                  HighlightShadow::half_angle,
                                                  HighlightShadow::both, HighlightShadow::none};

constexpr std::string_view name_of(HighlightShadow shadow) {
    switch (shadow) {
    case HighlightShadow::light:
        return "light";
    case HighlightShadow::half_angle:
        return "half_angle";
    case HighlightShadow::both:
        return "both";
    case HighlightShadow::none:
        break;
    }
    return "none";
}

constexpr bool by_light(HighlightShadow shadow) {
    return shadow == HighlightShadow::light || shadow == HighlightShadow::both;
}
constexpr bool by_half_angle(HighlightShadow shadow) {
    return shadow == HighlightShadow::half_angle || shadow == HighlightShadow::both;
}

/// Exponents are powers of two, made by squaring, as register combiners make the eighth.
inline constexpr int largest_squarings = 7;

struct Highlight {
    HighlightShadow shadow = HighlightShadow::light;
    int squarings = 3;
    int exponent() const { return 1 << squarings; }
    friend bool operator==(const Highlight&, const Highlight&) = default;
};

struct Scene {
    std::string name;                   ///< bundled name, or the file's stem
    std::filesystem::path file;         ///< as given
    double unit = 1;                    ///< what a length of 1 is in the file's units: a power of
                                        ///< two, 1 unless the file's scale is extreme (admission.h)
    std::vector<glm::vec3> positions;   ///< world space; the same array goes to OpenGL
    std::vector<glm::uvec3> triangles;  ///< into positions; counter-clockwise from the front, the
                                        ///< winding of mirrored nodes is already restored
    std::vector<Mesh> meshes;           ///< cover all triangles, in order, without gaps
    std::vector<Material> materials;    ///< at least one
    std::vector<Surface> surfaces;      ///< three per triangle, in the order of its corners; empty
                                        ///< where no material of a mesh has a bump map
    std::vector<TextureImage> textures; ///< what such a scene's materials need
    std::vector<AlphaMask> masks;       ///< empty where no material of a mesh has one
    std::vector<glm::vec2> mask_at;     ///< texture coordinates, one per position; empty likewise
    std::vector<glm::vec3> normals; ///< the file's, one per position: unit, world space, 0 where
                                    ///< it has none; empty unless asked for (SceneRequest)
    glm::dvec3 ambient{0, 0, 0};    ///< extras.shadowproof.ambient, linear
    bool inverse_square = false;    ///< extras.shadowproof.inverseSquare: the light's intensity
                                    ///< and distance count
    Highlight highlight{};          ///< extras.shadowproof.highlight
    std::optional<CubeFaces<glm::vec3>> environment; ///< what such a scene's surfaces reflect, all
                                                     ///< around in world axes, linear: the same
                                                     ///< texels go to OpenGL
    Camera camera;
    std::vector<Light> lights;   ///< at least one
    std::size_t light = 0;       ///< the one that is judged
    std::vector<Cause> provokes; ///< extras.shadowproof.provokes
    std::vector<Cause>
        may_provoke; ///< extras.shadowproof.provokesWide, in pictures that are wider than high
    bool declares_provokes = false; ///< whether the file says what it provokes
    bool default_framing = false;   ///< camera or light are not the file's (default_view.h)
    std::vector<std::string> notes; ///< for the console: defaults taken, things not evaluated
};

/// Corner k (0..2) of a triangle, its floats converted to double.
inline glm::dvec3 corner(const Scene& scene, std::uint32_t triangle, int k) {
    return scene.positions[scene.triangles[triangle][k]];
}

/// Positive where a triangle is wound counter-clockwise as seen from a homogeneous point (l, w),
/// negative where clockwise: (b - a) x (c - a) . (l - w a), with a the first of its corners by x,
/// y, z, and with an exact sign (orientation.h). Zero without area or in its plane.
double side(const Scene& scene, std::uint32_t triangle, const glm::dvec4& point);

/// Whether the scene is lit by bump maps: some mesh's material has one.
inline bool is_bump_lit(const Scene& scene) {
    return !scene.surfaces.empty();
}
/// Whether parts of some surfaces are left out.
inline bool has_masks(const Scene& scene) {
    return !scene.masks.empty();
}
/// Whether a material that is drawn has heights in units of space.
inline bool has_heights_in_space(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes)
        if (scene.materials[mesh.material].height_in_space) return true;
    return false;
}

/// Whether a material that is drawn has a bump map that its file asks to be mipmapped.
inline bool asks_for_mipmaps(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes) {
        const Material& material = scene.materials[mesh.material];
        if (material.bump != Bump::none && scene.textures[material.bump_map].mipmaps) return true;
    }
    return false;
}

inline const Light& chosen_light(const Scene& scene) {
    return scene.lights[scene.light];
}

/// How many lights the colours of a picture add up: of a bump-lit scene the chosen one and those
/// before it, of others none.
inline std::size_t added_lights(const Scene& scene) {
    return is_bump_lit(scene) ? scene.light + 1 : 0;
}
/// The scene under each of them but the chosen one, in their order.
std::vector<Scene> under_lights_before(const Scene& scene);

/// Index into Scene::meshes of the mesh that holds a triangle.
std::uint32_t mesh_of(const Scene& scene, std::uint32_t triangle);

/// Whether a triangle has an alpha mask.
inline bool has_mask(const Scene& scene, std::uint32_t triangle) {
    return has_masks(scene) &&
           scene.materials[scene.meshes[mesh_of(scene, triangle)].material].mask != no_mask;
}

/// One flag per triangle: 1 where its material is double sided, its mesh casts, its mesh receives.
std::vector<std::uint8_t> double_sided_triangles(const Scene& scene);
std::vector<std::uint8_t> casting_triangles(const Scene& scene);
std::vector<std::uint8_t> receiving_triangles(const Scene& scene);

/// Per triangle the index of its mask, or no_mask; empty where the scene has none.
std::vector<std::uint32_t> masks_of_triangles(const Scene& scene);

} // namespace shadowproof
