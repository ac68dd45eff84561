// What a light sees, as sampled by the texels of a shadow map or by shadow rays.
#pragma once

#include "compare/picture/predict.h"

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace shadowproof {

/// Right, up and forward of a light's camera, orthonormal; forward is where the light shines to.
struct LightAxes {
    glm::dvec3 right{1, 0, 0};
    glm::dvec3 up{0, 1, 0};
    glm::dvec3 forward{0, 0, -1};
};

/// A point as a light's camera sees it: x and y across, of a spot at depth 1, of a directional
/// light in world units; z is the depth, from the light, or from the origin where it is
/// directional.
glm::dvec3 place_from_light(const Light& light, const LightAxes& axes, const glm::dvec3& point);

/// The axes that renderers give such a light's camera: it looks along the light, and one of the
/// world's axes is up.
std::vector<LightAxes> usual_axes(const Light& light);

/// A shadow map in one plane: of a spot or a directional light.
struct TexelPlane {
    LightAxes axes;
    double side = 0;         ///< of a texel, in the units of place_from_light; 0: none to speak of
    glm::dvec2 corner{0, 0}; ///< where some texel begins, in texels from x = y = 0
    bool is_exact = false;   ///< as a renderer has it, and not read off the picture
};

/// Places between which there is a map; elsewhere all is lit, or all in shadow.
struct LightFrustum {
    LightAxes axes;
    Visibility outside = Visibility::lit;
    glm::dvec3 low{-std::numeric_limits<double>::infinity()};
    glm::dvec3 high{std::numeric_limits<double>::infinity()};
    bool holds(const glm::dvec3& place) const;
};

/// Texels along a side: engines offer powers of two.
inline constexpr int smallest_map = 64;
inline constexpr int largest_map = 8192;

/// Over which texels comparisons are averaged.
struct MapFilter {
    enum class Over : std::uint8_t {
        texels, ///< whole ones, a square of those around the point
        square, ///< around the point itself, with parts of texels: bilinear filtering is of width 1
        points, ///< single places, as a PCFShadowMap of three.js (r170) asks them: in a plane 17,
                ///< to a texel away; on a cube 9, moved along each axis by the distance from the
                ///< light over twice its texels
    };
    int width = 0; ///< texels a side; 0: none are averaged. Points lie within 2
    Over over = Over::texels;
    /// The share of light from which a pixel is nearer to lit than to shadowed.
    double lit_from = 0.5;
};

/// In a picture of linear values half the light is half way; in sRGB a third or so is, as half way
/// between 60 and 190 of 255 is 0.34 of the way in linear light.
inline constexpr std::array usual_lit_from{0.5, 0.35};
inline constexpr std::array<MapFilter, 6> usual_filters{{{2, MapFilter::Over::texels},
                                                         {3, MapFilter::Over::texels},
                                                         {5, MapFilter::Over::texels},
                                                         {1, MapFilter::Over::square},
                                                         {3, MapFilter::Over::square},
                                                         {2, MapFilter::Over::points}}};

struct LightSampling {
    /// Sides of single-sided casters that are left out.
    enum class Culled : std::uint8_t { none, front, back };
    Culled culled = Culled::none;
    int texels = 0; ///< along each side of a cube's faces; 0: as finely as floats resolve
    /// Texels by which a lookup stays inside each face, so that no neighbouring texel lies on
    /// another face: for faces that lie side by side in one picture.
    int inset = 0;
    double range = std::numeric_limits<double>::infinity(); ///< from the light
    bool range_along_axes = false; ///< of a cube: each face ends so far along its axis
    Visibility beyond_range = Visibility::lit;
    std::optional<TexelPlane> plane{}; ///< instead of a cube
    std::optional<LightFrustum> frustum{};
    MapFilter filter{};
};

/// How far something lies from a point light, on `way` from it, by that which ends a map: its
/// distance, or where ends lie along the axes of a cube's faces its depth in the face.
double reach_of(const glm::dvec3& way, bool along_axes);

/// In which numbers a map is compared.
enum class BiasOf : std::uint8_t {
    distance,      ///< from the light
    depth,         ///< along the axis of the light's camera
    inverse_depth, ///< its inverse, of which window depths are multiples but for a constant
};

/// What moves a comparison towards `lit`.
struct MapBias {
    BiasOf of = BiasOf::distance;
    double constant = 0; ///< in the numbers that are compared
    double slope = 0;    ///< times what the caster's own depth changes by over a texel
};

/// What the light's ray for a pixel tells of it.
struct LightSample {
    double own_depth = 0; ///< the pixel's, from a directional light along its direction
    double own_stretch = 1;
    double seen_depth = std::numeric_limits<double>::infinity(); ///< infinity: nothing is seen
    double seen_stretch = 1;                                     ///< distance over depth
    double slope = 0; ///< of the caster: change over a texel of its inverse depth, or of its depth
                      ///< where the light is directional
    /// How much further from the light the pixel is than what the light sees there, but for the
    /// constant bias. Minus infinity: nothing shadows it. Infinity: it lies outside, in shadow.
    double excess(const MapBias& bias, bool directional) const;
};

/// The scene as the light sees it: casters alone.
Scene seen_from_light(const Scene& scene, LightSampling::Culled culled);

/// For each point, in order. `light_tracer`: of seen_from_light.
std::vector<LightSample> sample_light(const Tracer& light_tracer, const LightSampling& view,
                                      std::span<const glm::dvec3> points);

/// Lit, except where the light sees something that is closer to it by more than the bias.
Predict lit_within(const TracedScene& traced, const LightSampling& view, const MapBias& bias);

} // namespace shadowproof
