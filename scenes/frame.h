// What one technique says of one scene: the pictures read back, and how it counted, which is all
// that is needed to predict them.
#pragma once

#include "scenes/image.h"
#include "scenes/lighting_settings.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace shadowproof {

/// What a pixel shows; the values are those of the class map, 8-bit gray.
enum class Visibility : std::uint8_t { background = 0, shadowed = 64, lit = 255 };

/// How a stencil technique counts the faces of the shadow volumes at a pixel.
struct Counting {
    enum class Test : std::uint8_t {
        depth_pass, ///< faces in front of the surface: front +1, back -1
        depth_fail, ///< faces behind the surface: back +1, front -1
    };
    Test test = Test::depth_fail;
    /// What a counted face does to the counter.
    enum class Operation : std::uint8_t {
        wrap,     ///< one more or less, modulo 2^bits
        saturate, ///< one more or less, but never past 0 and 2^bits - 1
        invert,   ///< all bits turn over: only whether the count is odd is kept
    };
    Operation operation = Operation::wrap;
    /// What the counter holds before any face is counted.
    enum class Start : std::uint8_t {
        zero,
        eye,        ///< the number of volumes around the eye
        near_plane, ///< the number of volumes around the point of the near plane
    };
    Start start = Start::zero;
    bool depth_clamp = false;  ///< faces past the near and far planes are kept
    bool light_cap = true;     ///< the light-facing triangles themselves are drawn
    bool dark_cap = true;      ///< so are they at infinity, where the projection keeps them
    int bits = 8;              ///< of the counter
    bool holes_filled = false; ///< open casters are closed before volumes are made of them
    /// A flag a triangle of the scene: its corners run the other way round where volumes are made
    /// of it (see counted_casters.h). Empty: nowhere.
    std::vector<std::uint8_t> turned{};
    /// By how much the volumes' far ends lie further from the light than their casters, in world
    /// units; infinite: at infinity.
    double extrusion = std::numeric_limits<double>::infinity();

    /// What holds of one caster where casters are not counted alike.
    struct Caster {
        Test test = Test::depth_fail;
        bool left_out = false; ///< it has no volume
        bool light_cap = true;
        bool dark_cap = true;
        friend bool operator==(const Caster&, const Caster&) = default;
    };
    /// One a triangle of the scene; empty: all as above. `light_cap` and `dark_cap` above are then
    /// true, as those left out are those that make no difference.
    std::vector<Caster> casters{};

    Caster caster(std::uint32_t triangle) const {
        if (triangle < casters.size()) return casters[triangle];
        return {test, false, light_cap, dark_cap};
    }
};

/// The counter as a buffer of `counting.bits` holds it. A saturating one has been kept in
/// its range step by step.
inline std::uint32_t stored(std::int64_t count, const Counting& counting) {
    const std::int64_t most = (std::int64_t{1} << counting.bits) - 1;
    if (counting.operation == Counting::Operation::invert) count = (count & 1) != 0 ? most : 0;
    return static_cast<std::uint32_t>(count & most);
}

/// How window depth is made and stored.
struct DepthModel {
    enum class Projection : std::uint8_t { finite, finite_reversed, infinite, infinite_reversed };
    Projection projection = Projection::finite;
    double near = 0.1;
    double far = std::numeric_limits<double>::infinity(); ///< of the projection, where finite
    bool floating = false;                                ///< D32F; otherwise 24-bit fixed point
    bool eye_relative = false; ///< vertices are made relative to the eye before the matrix
    int subpixel_bits = 8;     ///< GL_SUBPIXEL_BITS
    double front = 0; ///< window depth of the near plane; more than 0 leaves a ledge before it

    /// Window depth falls away from the eye, from 1 at the near plane to 0.
    bool reversed() const {
        return projection == Projection::finite_reversed ||
               projection == Projection::infinite_reversed;
    }
    bool finite() const {
        return projection == Projection::finite || projection == Projection::finite_reversed;
    }
};

/// How a depth buffer keeps window depth.
struct DepthFormat {
    int bits = 0;
    bool floating = false;
};

/// What a technique spared against drawing everything.
struct Savings {
    std::string against;     ///< the technique that does
    double milliseconds = 0; ///< a frame
    std::int64_t volume_fragments = 0;
    double plan_milliseconds = 0; ///< spent once on finding out what to spare
};

struct Frame {
    Image<Visibility> claim;
    Image<std::uint32_t> counter;  ///< as read back, before the light pass
    Image<float> depth;            ///< window depth in [0, 1]
    DepthFormat depth_format{};    ///< of the buffer, as the driver names it
    Image<std::uint32_t> triangle; ///< index into Scene::triangles, or no_triangle
    /// Claimed colours where the technique lights bump maps, else empty: linear, as blending left
    /// them: floats neither clamped nor rounded, or k / 255 where the buffer holds bytes.
    /// Background is black.
    Image<glm::vec3> color{};
    ColorModel color_model{}; ///< how they were made
    Counting counting;
    DepthModel depth_model;
    double milliseconds = 0; ///< making the volumes, drawing and finishing, without the read-back
    std::uint64_t volume_fragments = 0; ///< that the volumes' faces cover, hidden or not
    /// How many of them are not behind what is seen, at most 255: the volumes as a picture.
    Image<std::uint8_t> volumes;
    std::vector<std::string> left_out; ///< what this scene did not need of it, one clause each
    std::optional<Savings> saved;      ///< by leaving it out
};

/// The driver behind a frame, as it names itself.
struct DriverInfo {
    std::string version;
    std::string renderer;
    int subpixel_bits = 0;
    int depth_bits = 0;
    int stencil_bits = 0;
};

} // namespace shadowproof
