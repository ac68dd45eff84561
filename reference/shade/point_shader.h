// Lighting of up to sixteen points, by the definition in shading.h.
#pragma once

#include "reference/shade/lighting_lanes.h"
#include "reference/shade/shading.h"
#include "reference/trace/state.h"
#include "scenes/surface/texel_sides.h"

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <vector>

namespace shadowproof {

/// What shading needs in addition to the scene, made once.
struct ShadingTables {
    const Tracer::State* state = nullptr;
    /// One per material; empty where it has no height field.
    std::shared_ptr<const std::vector<Image<glm::dvec2>>> slopes;
    LaneLight light;
    glm::dvec3 light_color{1, 1, 1}; ///< times the intensity, where that counts
};

ShadingTables make_shading_tables(const Tracer& tracer);
/// Of the same scene under another light: shares what does not depend on it.
ShadingTables make_shading_tables(const Tracer& tracer, const ShadingTables& other);

/// Shades the points of one thread; keeps what it has computed of triangles.
class PointShader {
public:
    explicit PointShader(const ShadingTables& tables) : tables_(&tables), known_(kept_triangles) {}

    /// The point of `triangle` that is seen along a line of sight.
    void set(std::size_t lane, const glm::dvec3& line, std::uint32_t triangle, bool lit);

    /// Shades all points that are set. Afterwards, lane by lane:
    void shade() { light_lanes(tables_->light, lanes_); }
    glm::dvec3 color(std::size_t lane) const;
    /// What its light adds to ambient light and reflections.
    glm::dvec3 added_color(std::size_t lane) const;
    Shading terms(std::size_t lane) const;

private:
    /// One value per corner.
    template <class T>
    using ThreeOf = std::array<T, 3>;

    /// A triangle, less the eye, and its surface, in double.
    struct Known {
        std::uint32_t triangle = no_triangle;
        const Material* material = nullptr;
        const Image<glm::dvec2>* slopes = nullptr;
        glm::dvec3 point{0, 0, 0};    ///< the first corner
        glm::dvec3 edge_b{0, 0, 0};   ///< from there to the second
        glm::dvec3 edge_c{0, 0, 0};   ///< from there to the third
        glm::dvec3 across{0, 0, 0};   ///< the triangle: edge_b x edge_c
        glm::dvec3 toward_b{0, 0, 0}; ///< edge_c x point, where all lines start at the eye
        glm::dvec3 toward_c{0, 0, 0}; ///< point x edge_b, likewise
        ThreeOf<glm::dvec3> normals{};
        ThreeOf<glm::dvec3> tangents{};
        ThreeOf<glm::dvec2> decal_at{};
        ThreeOf<glm::dvec2> bump_at{};
        TexelSides texel{}; ///< where heights are in units of space
        double hand = 1;
        double side = 1;
    };
    /// A tile has fewer triangles around it, and they fit a first-level cache.
    static constexpr std::size_t kept_triangles = 64;

    /// What lighting_lanes.h does not need.
    struct Look {
        const Material* material = nullptr;
        glm::dvec3 decal{0, 0, 0};
        double gloss = 1;
        bool lit = false;
        glm::dvec3 weights{0, 0, 0};
    };
    struct Summands {
        glm::dvec3 diffuse, specular, ambient, reflection;
    };

    const ShadingTables* tables_;
    std::vector<Known> known_; ///< each triangle at its number modulo kept_triangles
    LightingLanes lanes_;
    Lanes<Look> looks_{};

    const Known& known(std::uint32_t triangle);
    void learn(std::uint32_t triangle, Known& known) const;
    glm::dvec3 bump_at(const Known& known, const glm::dvec3& weights) const;
    glm::dvec3 gradient(const Known& known, const glm::dvec3& normal, const glm::dvec3& bump) const;
    Look look_at(const Known& known, const glm::dvec3& weights) const;
    glm::dvec3 reflection(std::size_t lane) const;
    Summands summands(std::size_t lane) const;
    glm::dvec3 tangent(std::size_t lane) const;
};

} // namespace shadowproof
