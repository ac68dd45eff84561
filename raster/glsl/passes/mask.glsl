// Alpha masks, read as scenes/texture.h defines it.
#include texels.glsl

layout(binding = 6) uniform sampler2D mask_alpha;

layout(location = 31) uniform float least_alpha; // below it the surface is left out
layout(location = 32) uniform int mask_wrap_s;   // values of Wrap
layout(location = 33) uniform int mask_wrap_t;
layout(location = 34) uniform bool reads_nearest; // texel

in Masked { vec2 at; } masked;

// a + f (b - a), which equal texels leave unchanged; mix() may be another formula.
float between(float a, float b, float f) {
    return a + f * (b - a);
}

float row_of_alpha(Taps s, int row) {
    return between(texelFetch(mask_alpha, ivec2(s.first, row), 0).r,
                   texelFetch(mask_alpha, ivec2(s.second, row), 0).r, s.fraction);
}

bool is_left_out() {
    ivec2 size = textureSize(mask_alpha, 0);
    if (reads_nearest) {
        ivec2 texel = ivec2(texel_at(mask_wrap_s, size.x, masked.at.x),
                            texel_at(mask_wrap_t, size.y, masked.at.y));
        return texelFetch(mask_alpha, texel, 0).r < least_alpha;
    }
    Taps s = taps_at(mask_wrap_s, size.x, masked.at.x);
    Taps t = taps_at(mask_wrap_t, size.y, masked.at.y);
    return between(row_of_alpha(s, t.first), row_of_alpha(s, t.second), t.fraction) < least_alpha;
}
