// Rays of any origin and direction: which triangles they may meet, and which they meet exactly. For
// rays that a float tracer shot; their floats are taken as exact.
#pragma once

#include "reference/exact/predicates.h"
#include "reference/trace/packet.h"
#include "reference/trace/trace.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>

namespace shadowproof {

/// origin + t direction, near < t <= far.
struct AnyRay {
    glm::dvec3 origin{0, 0, 0};
    glm::dvec3 direction{0, 0, 0};
    double near = 0;
    double far = std::numeric_limits<double>::infinity();
};

/// Up to sixteen rays that are sent together.
struct AnyRays {
    alignas(64) std::array<Lanes<double>, 3> origin{};
    alignas(64) std::array<Lanes<double>, 3> direction{};
    alignas(64) Lanes<double> near{};
    alignas(64) Lanes<double> far{}; ///< hits beyond it are not searched for
    std::uint32_t lanes = 0;         ///< one bit per ray whose search goes on

    void set(int lane, const AnyRay& ray);
    AnyRay ray(int lane) const;
};

/// Receives the triangles that rays come near. It may lower AnyRays::far, and clear bits of
/// AnyRays::lanes.
class NearbyTriangles {
public:
    NearbyTriangles() = default;
    NearbyTriangles(const NearbyTriangles&) = delete;
    NearbyTriangles& operator=(const NearbyTriangles&) = delete;
    virtual ~NearbyTriangles() = default;
    /// `lanes`: the rays that come near a box around the triangle, and perhaps others.
    virtual void visit(AnyRays& rays, std::uint32_t triangle, std::uint32_t lanes) = 0;
};

/// The smallest component of a direction that Embree's traversal distinguishes from zero: it
/// replaces smaller ones by this (min_rcp_input of its math/constants.h, in rcp_safe).
inline constexpr double least_component = 1e-18;

/// Visits at least all triangles whose own box a ray meets when it is enlarged, on each axis, by
/// `share` of the largest coordinate there (of ray origin and scene) and by `share` of 2^-32 of the
/// largest of all. Components of directions below least_component may then have any value up to it.
void find_nearby(const Tracer& tracer, double share, AnyRays& rays, NearbyTriangles& found);

/// How much find_nearby enlarges boxes for a ray.
glm::dvec3 enlargement(const Tracer& tracer, double share, const glm::dvec3& origin);

/// Whether the ray meets the closed triangle within its limits, exactly; never where it runs in the
/// triangle's plane.
bool meets(const AnyRay& ray, const Corners& t);

/// Whether it meets the triangle's plane within its limits; the plane may not hold it.
bool meets_plane(const AnyRay& ray, const Corners& t);

/// Whether the triangle's mask, if it has one, leaves it standing where the ray meets its plane,
/// which may not hold the ray; exactly.
bool stands_on_ray(const Tracer& tracer, const AnyRay& ray, std::uint32_t triangle);

/// Sign of t(T) - t(U), the places at which the ray meets their planes; neither may hold it.
int order_along(const AnyRay& ray, const Corners& t, const Corners& u);

/// Whether the triangle lies between the light and the exact point where the ray meets the plane of
/// `seen`, decided as for the truth (Visibility).
bool stands_between(const Tracer& tracer, const AnyRay& ray, std::uint32_t seen,
                    std::uint32_t triangle);

/// Whether that point lies in the light's cone; true where the light has none.
bool within_cone(const Tracer& tracer, const AnyRay& ray, std::uint32_t seen);

/// Whether the light is on the side of the triangle's plane that the scene's eye sees.
bool faces_light(const Tracer& tracer, std::uint32_t triangle);
/// Whether the triangle receives shadows.
bool receives_shadows(const Tracer& tracer, std::uint32_t triangle);

} // namespace shadowproof
