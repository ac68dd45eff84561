// How near a traced technique's floats are to failing: computed from the truth, its model of rays
// and the roundings of a float tracer, never from what was traced.
#pragma once

#include "compare/traced/ray_check.h"

namespace shadowproof {

/// The number of pixels that rounding is expected to make wrong, over log 2: from 1 on it is more
/// likely than not that there is one, if they are taken for independent. Infinite where rays as the
/// model starts them, with exact numbers, do not give the truth: an epsilon passes over an
/// occluder, an offset leads past one or into one.
///
/// The point that is met is off along its normal by what rounds its distance and its coordinates,
/// and sideways by what rounds the eye ray as well. A ray that so starts below its surface meets
/// that, unless it is nearer than the model's distance; one that starts beside the point may have
/// another truth. How far off it is is reckoned by standard deviation
/// (compare/judge/normal_distribution.h). How Embree rounds at the edges of triangles is not part
/// of it, nor what lies beyond a silhouette; and where the model skips the point's own triangle,
/// another is taken to follow at each of its edges.
double strain(const TracedClaim& claim);

} // namespace shadowproof
