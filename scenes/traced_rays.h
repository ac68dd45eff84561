// Shadow rays traced in float: how a technique starts them, and the rays that it shot at each
// pixel, so that the very same rays can be traced exactly.
#pragma once

#include "scenes/image.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>

namespace shadowproof {

/// origin + t direction, near < t <= far.
struct FloatRay {
    glm::vec3 origin{0, 0, 0};
    glm::vec3 direction{0, 0, 0};
    float near = 0;
    float far = std::numeric_limits<float>::infinity();
};

/// How a shadow ray is kept from hitting the surface that it starts on.
struct RayModel {
    enum class Start : std::uint8_t {
        epsilon, ///< hits nearer than a constant do not count
        offset,  ///< it starts off the surface, along the normal on the light's side
        skip,    ///< it passes through its own triangle
    };
    Start start = Start::epsilon;
    float distance = 0; ///< the constant, in world units; 0 with skip
};

/// What the user asked for, in the file's units; where nothing is set, the customary constants.
struct RaySettings {
    std::optional<double> epsilon{};
    std::optional<double> offset{};
};

/// The constant that tutorials and renderers use: pbrt's RAY_EPSILON (Pharr & Humphreys 2004), and
/// the tnear of shadow rays in the tutorials of Embree.
inline constexpr double customary_epsilon = 1e-3;

/// The rays of one pixel.
struct TracedPixel {
    static constexpr std::uint32_t none = 0xffffffffU; ///< no triangle
    glm::vec3 line{0, 0, 0};                           ///< of sight (camera.h), in float
    std::uint32_t seen = none;                         ///< the triangle that it met first
    float depth = 0;                                   ///< where: its t
    FloatRay shadow{};
    bool shot = false;             ///< whether there was a shadow ray: sides that face away from
                                   ///< the light, and points outside its cone, need none
    std::uint32_t occluder = none; ///< a triangle that the shadow ray met: the first one found
};

struct TracedRays {
    RayModel model{};
    bool is_parallel = false;   ///< eye rays share their direction, otherwise their origin
    glm::vec3 eye{0, 0, 0};     ///< that origin
    glm::vec3 forward{0, 0, 0}; ///< that direction
    float near = 0;             ///< their limits
    float far = 0;
    Image<TracedPixel> pixels;

    FloatRay eye_ray(const glm::vec3& line) const {
        return {is_parallel ? line : eye, is_parallel ? forward : line, near, far};
    }
};

} // namespace shadowproof
