// Parallel lines of sight, those of an orthographic camera, as the eye's view has them: the eye is
// a direction, as a directional light is, and what lies higher (shear.h) is nearer.
#pragma once

#include "reference/trace/packet.h"
#include "reference/trace/state.h"

#include <glm/vec3.hpp>
#include <utility>

namespace shadowproof {

/// Sets and activates the lanes' rays: along lines of sight, within a range of depths.
void look_along(const Tracer::State& state, const Vectors& lines, std::uint32_t lanes,
                const SeenRange& range, RayPacket& packet);

/// Between which heights the point of a line of sight lies whose depth is t, give or take t_error.
std::pair<double, double> heights_at(const Tracer::State& state, const glm::dvec3& line, double t,
                                     double t_error);

} // namespace shadowproof
