// How exactly a driver draws into colour buffers of 8 bits a channel: by how much what is kept is
// off the exact result, clamped to [0, 1], in steps of 1/255. As measured on llvmpipe by the tests
// of the same name; OpenGL leaves it to the driver. A float that is blended is rounded to a byte
// before, so that overwriting_error comes first.
#pragma once

namespace shadowproof {

/// Of a float that overwrites: to the nearest byte, but for a thousandth where two are as near.
inline constexpr double overwriting_error = 0.501;

/// Of two bytes multiplied (GL_DST_COLOR, GL_ZERO): of all 65,536 pairs the worst is 128/255.
inline constexpr double multiplying_error = 0.502;

/// Of two bytes added (GL_ONE, GL_ONE), which clamps at 1.
inline constexpr double adding_error = 0;

} // namespace shadowproof
