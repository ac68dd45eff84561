// Signs that are always right: a filter in double decides nearly all, exact arithmetic the rest.
// Inputs are taken as exact: vertices (float32 held in doubles), eye, light and ray direction.
#pragma once

#include "reference/exact/exactness.h"
#include "scenes/scene.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace shadowproof {

struct Corners {
    glm::dvec3 a, b, c;
};

struct Decision {
    int sign = 0; ///< -1, 0 or 1
    Exactness exactness = Exactness::filtered;
};

/// A point Q = E + (n / d) D of an eye ray, which starts at E, kept as the exact quotient, or one
/// of its ends at infinity.
struct RayPoint {
    enum class Kind : std::uint8_t {
        surface,  ///< where the ray meets the plane of `surface`
        depth,    ///< at view depth `depth`
        infinity, ///< the direction D itself
        eye,      ///< the direction -D, where the eye is of lines of sight that are parallel
    };
    Kind kind = Kind::infinity;
    Corners surface{};
    double depth = 0;
};

/// The eye ray of a query, and the light that its points are looked at from: (position, 1), or the
/// direction to a directional one, 0 (scenes/scene.h). It starts at the eye or, where lines of
/// sight are parallel, in the plane of the eye.
struct EyeRay {
    glm::dvec3 start;
    glm::dvec3 direction;
    glm::dvec4 light;
};

/// A spot light's cone, its doubles taken as exact.
struct Cone {
    glm::dvec3 apex{0, 0, 0};
    glm::dvec3 axis{0, 0, -1};
    double cosine = 0; ///< of half the opening angle
};

class Predicates {
public:
    Predicates() = default;
    explicit Predicates(Filters filters) : filters_(filters) {}

    /// Sign of det(w a - o, b - a, c - a), O = (o, w) a point or a direction: negative where O sees
    /// the triangle counter-clockwise, its front. Degree 3.
    Decision side(const glm::dvec4& o, const Corners& t) const;

    /// Sign of D . ((a - E) x (b - E)): the side of edge ab on which the eye ray passes. Degree 3.
    Decision edge(const EyeRay& ray, const glm::dvec3& a, const glm::dvec3& b) const;

    /// Sign of t(T) - t(U), the depths at which the eye ray meets the planes of T and U.
    /// Neither plane may hold the ray's direction or its start. Degree 6.
    Decision depth_order(const EyeRay& ray, const Corners& t, const Corners& u) const;

    /// Sign of t(T) - depth. Degree 3.
    Decision depth_against(const EyeRay& ray, const Corners& t, double depth) const;

    /// Sign of (Q - a) . ((w a - l) x (b - a)), L = (l, w): the side of edge ab, seen from the
    /// light, on which Q lies. Degree 6 for a surface point. At infinity: for points far enough
    /// along the ray, where the light is directional; the direction itself, where it is not.
    Decision shadow_edge(const EyeRay& ray, const RayPoint& q, const glm::dvec3& a,
                         const glm::dvec3& b) const;

    /// The same with ties broken: where the sign is zero, that of Q moved by (e, e^2, e^3), e -> 0.
    /// All edges use the same move, so a ray through a shared edge or vertex is counted
    /// consistently (Edelsbrunner & Muecke 1990, Simulation of Simplicity). The eye at infinity
    /// moves the other way: it remains opposite to the ray's end.
    Decision shadow_edge_untied(const EyeRay& ray, const RayPoint& q, const glm::dvec3& a,
                                const glm::dvec3& b) const;

    /// Sign of D . ((w a - l) x (b - a)): the side of the plane through the light and an edge to
    /// which the ray runs. Ties are broken by the same move of D. Degree 3.
    Decision towards_shadow_edge_untied(const EyeRay& ray, const glm::dvec3& a,
                                        const glm::dvec3& b) const;

    /// Sign of (Q - a) . ((b - a) x (c - a)): the side of U's plane on which Q lies. Degree 6 for a
    /// surface point; for a point at infinity that of the direction.
    Decision side_of_point(const EyeRay& ray, const RayPoint& q, const Corners& u) const;

    /// The same with ties broken, by the move of shadow_edge_untied. U must not be degenerate.
    Decision side_of_point_untied(const EyeRay& ray, const RayPoint& q, const Corners& u) const;

    /// Whether D is exactly a negative multiple of the direction to a directional light: the one
    /// direction in which shadow volumes never end.
    bool runs_from_light(const EyeRay& ray) const;

    /// Sign of (Q - apex) . axis - cosine |Q - apex| for a surface point: not negative within the
    /// cone. Degree 12, squared.
    Decision within_cone(const EyeRay& ray, const RayPoint& q, const Cone& cone) const;

private:
    Filters filters_ = Filters::on;
};

} // namespace shadowproof
