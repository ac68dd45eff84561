// Error bounds for drawing into colour buffers of 8 bits per channel: how far the stored value may
// be from the exact result, clamped to [0, 1], in steps of 1/255. OpenGL leaves this to the driver;
// these are measured on llvmpipe by the tests of the same name. A float that is blended is first
// rounded to a byte, so overwriting_error applies before the other two.
#pragma once

namespace shadowproof {

/// A float overwrites: it is rounded to the nearest byte. The thousandth is for floats half way
/// between two.
inline constexpr double overwriting_error = 0.501;

/// Two bytes are multiplied (GL_DST_COLOR, GL_ZERO): the worst of all 65,536 pairs is 128/255.
inline constexpr double multiplying_error = 0.502;

/// Two bytes are added (GL_ONE, GL_ONE), clamped at 1.
inline constexpr double adding_error = 0;

} // namespace shadowproof
