// Window depth: how a technique computes it, and how a depth buffer stores it.
#pragma once

#include <cstdint>
#include <limits>

namespace shadowproof {

/// How window depth is computed and stored.
struct DepthModel {
    enum class Projection : std::uint8_t { finite, finite_reversed, infinite, infinite_reversed };
    Projection projection = Projection::finite;
    double near = 0.1;
    double far = std::numeric_limits<double>::infinity(); ///< of the projection, where finite
    bool parallel = false;     ///< of an orthographic camera: window depth is linear in view depth
    bool floating = false;     ///< D32F; otherwise 24-bit fixed point
    bool eye_relative = false; ///< the eye is subtracted from vertices before the matrix is applied
    int subpixel_bits = 8;     ///< GL_SUBPIXEL_BITS
    double front = 0;          ///< the least window depth that is drawn; smaller ones are reserved:
                               ///< for what lies before the near plane or, where depth is
                               ///< reversed, for what is cleared
    bool clamp = false;        ///< GL_DEPTH_CLAMP: what lies past the near and far planes is kept

    /// Window depth decreases away from the eye, from 1 at the near plane to 0.
    bool reversed() const {
        return projection == Projection::finite_reversed ||
               projection == Projection::infinite_reversed;
    }
    bool finite() const {
        return projection == Projection::finite || projection == Projection::finite_reversed;
    }
    /// Whether what lies past the far plane is lost.
    bool clips_at_far() const { return finite() && !clamp; }
    /// Whether the background is as far as the far plane: what lies past that is lost, or clamped
    /// to the depth that is cleared. Else the background is further than all that is drawn.
    bool background_at_far() const {
        return clips_at_far() || (finite() && !(reversed() && front > 0));
    }
    friend bool operator==(const DepthModel&, const DepthModel&) = default;
};

/// How a depth buffer stores window depth.
struct DepthFormat {
    int bits = 0;
    bool floating = false;
    friend bool operator==(const DepthFormat&, const DepthFormat&) = default;
};

} // namespace shadowproof
