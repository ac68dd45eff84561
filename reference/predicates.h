// Signs that are always right: a filter in double decides nearly all, exact arithmetic the rest.
// Inputs are taken as exact: vertices (float32 held in doubles), eye, light and ray direction.
#pragma once

#include "reference/trace.h"

#include <cstdint>
#include <glm/vec3.hpp>

namespace shadowproof {

struct Corners {
    glm::dvec3 a, b, c;
};

struct Decision {
    int sign = 0; ///< -1, 0 or 1
    Exactness exactness = Exactness::filtered;
};

/// A point Q = E + (n / d) D of an eye ray, kept as the exact quotient, or its end at infinity.
struct RayPoint {
    enum class Kind : std::uint8_t {
        surface,  ///< where the ray meets the plane of `surface`
        depth,    ///< at view depth `depth`
        infinity, ///< the direction D itself
    };
    Kind kind = Kind::infinity;
    Corners surface{};
    double depth = 0;
};

/// The eye ray of a query, and the light that its points are looked at from.
struct EyeRay {
    glm::dvec3 eye;
    glm::dvec3 direction;
    glm::dvec3 light;
};

class Predicates {
public:
    /// `rationals`: some input lies outside the range that expansions can hold (exact.h).
    explicit Predicates(bool rationals = false) : rationals_(rationals) {}

    /// Sign of det(a - o, b - o, c - o): negative where o sees the triangle counter-clockwise,
    /// its front. Degree 3.
    Decision side(const glm::dvec3& o, const Corners& t) const;

    /// Sign of D . ((a - E) x (b - E)): the side of edge ab on which the eye ray passes. Degree 3.
    Decision edge(const EyeRay& ray, const glm::dvec3& a, const glm::dvec3& b) const;

    /// Sign of t(T) - t(U), the depths at which the eye ray meets the planes of T and U.
    /// Neither plane may hold the ray's direction or the eye. Degree 6.
    Decision depth_order(const EyeRay& ray, const Corners& t, const Corners& u) const;

    /// Sign of t(T) - depth. Degree 3.
    Decision depth_against(const EyeRay& ray, const Corners& t, double depth) const;

    /// Sign of (Q - L) . ((a - L) x (b - L)): the side of edge ab, seen from the light, on which Q
    /// lies. Degree 6 for a surface point.
    Decision shadow_edge(const EyeRay& ray, const RayPoint& q, const glm::dvec3& a,
                         const glm::dvec3& b) const;

    /// The same with ties broken: where the sign is zero, that of Q moved by (e, e^2, e^3), e -> 0.
    /// All edges use the same move, so a ray through a shared edge or vertex is counted
    /// consistently (Edelsbrunner & Muecke 1990, Simulation of Simplicity).
    Decision shadow_edge_untied(const EyeRay& ray, const RayPoint& q, const glm::dvec3& a,
                                const glm::dvec3& b) const;

    /// Sign of (Q - a) . ((b - a) x (c - a)): the side of U's plane on which Q lies. Degree 6 for a
    /// surface point; for the point at infinity that of the direction D.
    Decision side_of_point(const EyeRay& ray, const RayPoint& q, const Corners& u) const;

private:
    bool rationals_;
};

} // namespace shadowproof
