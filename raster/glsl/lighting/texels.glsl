// Sampling at level 0, texel by texel, bilinear but where it says otherwise: the weights of a driver's
// own filter may have no more than 8 bits.

const int wrap_repeat = 0; // values of Wrap
const int wrap_mirrored_repeat = 1;
const int wrap_clamp_to_edge = 2;

// The two texels around a coordinate along one axis, and how far it lies from the first to the
// second.
struct Taps {
    int first;
    int second;
    float fraction;
};

int mirrored(int texel, int n) {
    if (texel < 0) return -1 - texel;
    if (texel >= 2 * n) return texel - 2 * n;
    return texel < n ? texel : 2 * n - 1 - texel;
}

Taps taps_at(int wrap, int texels, float at) {
    if (wrap == wrap_repeat) at -= floor(at);
    if (wrap == wrap_mirrored_repeat) at -= 2 * floor(at / 2);
    float x = float(texels) * at - 0.5;
    if (wrap == wrap_clamp_to_edge) x = clamp(x, 0, float(texels - 1));
    int first = int(floor(x));
    float fraction = x - floor(x);
    if (wrap == wrap_repeat)
        return Taps(first < 0 ? texels - 1 : first, first + 1 >= texels ? 0 : first + 1, fraction);
    if (wrap == wrap_mirrored_repeat)
        return Taps(mirrored(first, texels), mirrored(first + 1, texels), fraction);
    return Taps(first, min(first + 1, texels - 1), fraction);
}

// The texel that holds a coordinate.
int texel_at(int wrap, int texels, float at) {
    if (wrap == wrap_repeat) at -= floor(at);
    if (wrap == wrap_mirrored_repeat) at -= 2 * floor(at / 2);
    float place = float(texels) * at;
    if (wrap == wrap_clamp_to_edge) place = clamp(place, 0, float(texels - 1));
    int texel = int(floor(place));
    if (wrap == wrap_mirrored_repeat) texel = mirrored(texel, texels);
    return clamp(texel, 0, texels - 1);
}

vec4 sampled(sampler2D map, Taps s, Taps t) {
    vec4 upper = mix(texelFetch(map, ivec2(s.first, t.first), 0),
                     texelFetch(map, ivec2(s.second, t.first), 0), s.fraction);
    vec4 lower = mix(texelFetch(map, ivec2(s.first, t.second), 0),
                     texelFetch(map, ivec2(s.second, t.second), 0), s.fraction);
    return mix(upper, lower, t.fraction);
}

// The texels before and after one, beyond the border by the wrap mode.
int before(int wrap, int texels, int texel) {
    return texel > 0 ? texel - 1 : (wrap == wrap_repeat ? texels - 1 : 0);
}
int behind(int wrap, int texels, int texel) {
    return texel + 1 < texels ? texel + 1 : (wrap == wrap_repeat ? 0 : texels - 1);
}

// Slopes of heights in red: central differences along a row and down the rows, in heights per
// texel.
vec2 slope_of_texel(sampler2D map, int wrap_s, int wrap_t, ivec2 texel) {
    ivec2 size = textureSize(map, 0);
    ivec2 low = ivec2(before(wrap_s, size.x, texel.x), before(wrap_t, size.y, texel.y));
    ivec2 high = ivec2(behind(wrap_s, size.x, texel.x), behind(wrap_t, size.y, texel.y));
    return 0.5 * vec2(texelFetch(map, ivec2(high.x, texel.y), 0).r -
                          texelFetch(map, ivec2(low.x, texel.y), 0).r,
                      texelFetch(map, ivec2(texel.x, high.y), 0).r -
                          texelFetch(map, ivec2(texel.x, low.y), 0).r);
}

vec2 sampled_slope(sampler2D map, int wrap_s, int wrap_t, Taps s, Taps t) {
    vec2 upper = mix(slope_of_texel(map, wrap_s, wrap_t, ivec2(s.first, t.first)),
                     slope_of_texel(map, wrap_s, wrap_t, ivec2(s.second, t.first)), s.fraction);
    vec2 lower = mix(slope_of_texel(map, wrap_s, wrap_t, ivec2(s.first, t.second)),
                     slope_of_texel(map, wrap_s, wrap_t, ivec2(s.second, t.second)), s.fraction);
    return mix(upper, lower, t.fraction);
}
