// One point's lighting, by the definition in shading.h.
#pragma once

#include "reference/shading.h"
#include "reference/state.h"

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <vector>

namespace shadowproof {

/// What shading needs beside the scene, made once.
struct ShadingTables {
    const Tracer::State* state = nullptr;
    std::vector<Image<glm::dvec2>> slopes; ///< a material; empty where it has no height field
    glm::dvec4 light{0, 0, 0, 1};          ///< homogeneous, a place less the eye
    glm::dvec3 light_color{1, 1, 1};       ///< times the intensity, where that counts
    bool spot = false;
    double cos_outer = 0;
    double cone_scale = 0; ///< 1 / max(0.001, cos inner - cos outer)
};

ShadingTables make_shading_tables(const Tracer& tracer);

/// One thread's means of shading; keeps what it knows of a triangle while points lie on it.
class PointShader {
public:
    explicit PointShader(const ShadingTables& tables) : tables_(&tables) {}

    /// The point that the eye ray along `direction` sees on `triangle`.
    Shading shade(const glm::dvec3& direction, std::uint32_t triangle, bool lit);

private:
    /// A value at each of three corners.
    template <class T>
    using Corners3 = std::array<T, 3>;

    /// The triangle, less the eye, and its surface, in double.
    struct Known {
        std::uint32_t triangle = no_triangle;
        const Material* material = nullptr;
        const Image<glm::dvec2>* slopes = nullptr;
        bool from_behind = false;
        Corners3<glm::dvec3> points{};
        Corners3<glm::dvec3> across{}; ///< b x c, c x a, a x b
        Corners3<glm::dvec3> normals{};
        Corners3<glm::dvec3> tangents{};
        Corners3<glm::dvec2> decal_at{};
        Corners3<glm::dvec2> bump_at{};
        double hand = 1;
    };

    const ShadingTables* tables_;
    Known known_;

    void learn(std::uint32_t triangle);
    glm::dvec3 bumped(const glm::dvec3& weights, const glm::dvec3& normal) const;
    glm::dvec3 bump_sample(const glm::dvec2& at) const;
    void set_decal(const glm::dvec3& weights, Shading& shading) const;
    void set_light(const glm::dvec3& point, Shading& shading) const;
};

} // namespace shadowproof
