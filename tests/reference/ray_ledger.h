// The ledger of one eye ray, from all triangles whose volumes may come near it: slow and simple, to
// test the ledgers of regions with.
#pragma once

#include "reference/predict/ledger.h"

#include <cstdint>
#include <vector>

namespace shadowproof {

/// The ledger along one ray: crossings by increasing depth from the eye on, the count at the eye,
/// and the count at infinity.
struct RayLedger {
    std::int32_t at_eye = 0;
    std::vector<Crossing> crossings;
    std::int32_t at_infinity = 0;
};

/// Light-facing triangles whose shadow volumes may come near an eye ray: gathered once, asked for
/// all rays whose direction differs from `direction` by at most `radius` a component.
struct NearbyVolumes {
    std::vector<std::uint32_t> triangles;
};
NearbyVolumes volumes_near(const Tracer& tracer, const glm::dvec3& direction, double radius);

/// Sides shared by two light-facing triangles cancel and are not listed. Double precision; ties as
/// they round. `direction` must lie within the radius that the volumes were gathered for.
RayLedger ray_ledger(const Tracer& tracer, const NearbyVolumes& volumes,
                     const glm::dvec3& direction);
RayLedger ray_ledger(const Tracer& tracer, const glm::dvec3& direction);

} // namespace shadowproof
