// Rays from the light to points of eye rays, sixteen at a time, as the light's view has them.
#pragma once

#include "reference/trace/packet.h"
#include "reference/trace/state.h"

#include <glm/vec3.hpp>
#include <optional>

namespace shadowproof {

/// Sets direction, error and limits of every lane: to the point at view depth t, off by t_error, of
/// the line of sight. Hits that count lie between the light and the point. The caller activates
/// lanes and says what is skipped.
void lead_to_points(const Tracer::State& state, const Vectors& lines, const Lanes<double>& t,
                    const Lanes<double>& t_error, RayPacket& packet);

struct LightRay {
    ApproximateDirection w;
    HitLimits limits;
};

/// From the light along the direction of a line of sight, or against it to an eye at infinity;
/// nothing where no triangle can be met.
std::optional<LightRay> lead_to_infinity(const Tracer::State& state, const glm::dvec3& line,
                                         RayPoint::Kind kind);

} // namespace shadowproof
