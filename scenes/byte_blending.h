// Error bounds for drawing into colour buffers of 8 bits per channel: how far the stored value may
// be from the exact result, clamped to [0, 1], in steps of 1/255. OpenGL leaves this to the driver.
#pragma once

namespace shadowproof {

struct ByteErrors {
    double overwriting = 0; ///< a float overwrites
    double multiplying = 0; ///< a byte is multiplied (GL_DST_COLOR, GL_ZERO)
    double adding = 0;      ///< to a byte is added (GL_ONE, GL_ONE), clamped at 1
    /// Whether a float is rounded to a byte before it is blended. If not, it may be rounded to
    /// anything, by no more than `overwriting`.
    bool rounds_before_blending = true;
};

/// Measured on llvmpipe by the tests of the same name: a float is rounded to the nearest byte (the
/// thousandth is for floats half way between two); of all 65,536 products of two bytes the worst is
/// off by 128/255; sums of two bytes are bytes.
inline constexpr ByteErrors llvmpipe_bytes{
    .overwriting = 0.501, .multiplying = 0.502, .adding = 0, .rounds_before_blending = true};

/// What Direct3D 11 asks of hardware: 0.6 of a step wherever a float becomes a normalised integer
/// (Microsoft, Direct3D 11.3 Functional Specification, 3.2.3.6). An NVIDIA H200 makes use of it:
/// there 61.51 becomes 61.
inline constexpr ByteErrors hardware_bytes{
    .overwriting = 0.6, .multiplying = 0.6, .adding = 0.6, .rounds_before_blending = false};

} // namespace shadowproof
