// Inputs of lighting that truth and technique compute in the same way, as ranges over the values
// interpolated at a pixel: tangent frame, incident light, decal, gloss, reflection. Float roundings
// are counted beside each formula.
#pragma once

#include "compare/driver/interpolated.h"
#include "compare/driver/lighting/lighting_inputs.h"
#include "compare/driver/lighting/vector_range.h"
#include "scenes/driver.h"

#include <cstdint>
#include <glm/mat3x3.hpp>

namespace shadowproof {

/// Float roundings of a perturbed normal that is made of what a texture gave, relative to its
/// length. By slopes, N + h_u A + h_v B: A and B are cross products of unit vectors (3), times a
/// slope (1); their sum (1), together 5 of |h_u| + |h_v|, which is at most sqrt(2) of the length,
/// as N, A and B are at right angles; the sum with N (1). By a normal times the frame: three
/// products and two sums, 3 of at most sqrt(3). Normalised: a square's products and sums (3), of
/// which the root takes half, the root (1), the quotient (1). So 8.1 and 3.5, or 5.2 and 3.5.
inline constexpr double perturbed_normal_roundings = 12;

/// Largest distance between two roundings of a unit tangent to floats: of three components, each
/// off by float_roundoff of up to 1 in both.
inline constexpr double polygon_tangent_error = 3.5 * float_roundoff;

const Material& material_of(const Scene& scene, std::uint32_t triangle);

/// T, B and N of the seen side, orthonormal, with an error bound for each.
struct TangentFrame {
    glm::dvec3 tangent, bitangent, normal;
    double tangent_off = 0;
    double bitangent_off = 0;
    double normal_off = 0;
};

/// The frame at the pixel's centre, exact.
TangentFrame centre_frame(const Shading& shading);
/// The frame with the errors of floats and of interpolation.
TangentFrame frame_range(const InputPoint& point);
/// The frame rotated into the axes in which a technique lights.
TangentFrame rotated(const glm::dmat3& axes, TangentFrame frame);
glm::dmat3 lighting_axes(const Scene& scene, const ColorModel& model);

/// Transforms a vector into tangent space.
VectorRange into(const TangentFrame& frame, const VectorRange& vector);
/// Transforms a vector of tangent space into the axes in which T, B and N are given.
Intervals out_of(const TangentFrame& frame, const VectorRange& vector);

/// Incident light, without visibility.
Intervals radiance_range(const Scene& scene, const Interpolated& interpolated);

struct DecalRange {
    Intervals color{};
    Interval gloss{1, 1};
};
DecalRange decal_range(const Scene& scene, const Material& material, const PlaceRange& at);

/// What a surface reflects of the scene's environment. `normal`: N' in world axes.
Intervals reflection_range(const Scene& scene, const Material& material, const Intervals& normal,
                           const Interpolated& interpolated, const Interval& gloss);

/// Fills in what truth and technique read alike at the point: incident light, decal, gloss,
/// material and ambient light and, where the technique `reflects`, the environment. inputs.bump
/// must be set. `frame`: takes the perturbed normal into world axes.
void add_surroundings(LightingInputs& inputs, const InputPoint& point, const TangentFrame& frame,
                      bool reflects);
/// The same of what reflects nothing, with a decal that is read otherwise.
void add_surroundings(LightingInputs& inputs, const InputPoint& point, const DecalRange& decal);

} // namespace shadowproof
