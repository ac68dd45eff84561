// Checks the rays of a traced claim: that each is the one that the technique says it shoots, and
// that its answer is that of exact tracing, but for what Embree's rounding may decide.
#pragma once

#include "compare/judge/judge.h"
#include "compare/traced/float_bounds.h"

#include <string>
#include <vector>

namespace shadowproof {

/// An EmbreeWorld's flags, found anew: one per triangle.
struct RayTables {
    std::vector<std::uint8_t> visible; ///< from the eye
    std::vector<std::uint8_t> casts;

    explicit RayTables(const Tracer& tracer);
};

/// A traced claim, and what its rays are checked with. Keeps references.
struct TracedClaim {
    const TracedScene& traced;
    const Frame& frame;
    RayTables tables{traced.tracer()};

    const Tracer& tracer() const { return traced.tracer(); }
    const Scene& scene() const { return traced.scene(); }
    const TracedRays& rays() const { return *frame.rays; }
    const TracedPixel& pixel(PixelPlace p) const { return frame.rays->pixels.at(p.x, p.y); }
    AnyRay eye_ray(PixelPlace p) const;
    AnyRay shadow_ray(PixelPlace p) const;
    /// Whether a shadow ray of the pixel may meet the triangle at all.
    bool may_stop(PixelPlace p, std::uint32_t triangle) const {
        return tables.casts[triangle] != 0 &&
               !(rays().model.start == RayModel::Start::skip && triangle == pixel(p).seen);
    }
};

/// The hit point that the technique computes in float from its eye ray: origin + depth * direction.
glm::vec3 rounded_hit(const TracedClaim& claim, PixelPlace p);

/// The shadow ray that the technique's model starts at that point. Its direction is zero where none
/// can be shot. `distance`: the epsilon or offset, in place of the model's own.
FloatRay expected_shadow_ray(const TracedClaim& claim, PixelPlace p, float distance);

AnyRay as_exact(const FloatRay& ray);

/// What is wrong with a pixel's rays, as the rest of a sentence that begins "the pixel's"; empty
/// where nothing is.
using RayFault = std::string_view;

/// Pixels of one tile of four by four, and what is wrong with each.
inline constexpr int ray_tile = 4;
struct RayTile {
    std::array<PixelPlace, packet_size> places{};
    std::uint32_t lanes = 0; ///< one bit per pixel within the picture
    std::array<RayFault, packet_size> faults{};
};

RayTile tile_at(const Frame& frame, int left, int top);
/// Fills in RayTile::faults.
void check_rays(const TracedClaim& claim, RayTile& tile);

/// What is wrong with the numbers that all pixels share: the eye, the rays' limits, the model's
/// distance.
RayFault fault_of_all(const TracedClaim& claim);

} // namespace shadowproof
