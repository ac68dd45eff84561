// Trilinear lookups in a mipmap, and several of them along a pixel's longer side.
// `anisotropy`: how many at most; defined before this text.

// A pixel's extent over a texture.
struct Footprint {
    float level;  // of which a texel is as large as the pixel, or as a lookup's part of it
    float probes; // lookups
    vec2 along;   // its longer side, in texture coordinates
};

// From the derivatives of texture coordinates along the picture's rows and columns, over a texture
// of so many texels. Lookups as EXT_texture_filter_anisotropic suggests.
Footprint footprint(vec2 across, vec2 down, ivec2 size) {
    vec2 x = across * vec2(size);
    vec2 y = down * vec2(size);
    float xx = dot(x, x);
    float yy = dot(y, y);
    float longer = sqrt(max(xx, yy));
    float shorter = sqrt(min(xx, yy));
    float most = float(anisotropy);
    float probes = shorter * most > longer ? min(most, ceil(longer / shorter)) : most;
    float texels = longer / probes;
    return Footprint(texels > 1 ? log2_of(texels) : 0, probes, xx >= yy ? across : down);
}

// A level's size is not asked of the driver: Mesa 22's llvmpipe answers for all pixels that it
// shades at once with the size of the first one's level, covered or not.
vec4 sampled_level(sampler2D map, int wrap_s, int wrap_t, vec2 at, int level) {
    ivec2 size = max(textureSize(map, 0) >> level, ivec2(1));
    Taps s = taps_at(wrap_s, size.x, at.x);
    Taps t = taps_at(wrap_t, size.y, at.y);
    vec4 upper = mix(texelFetch(map, ivec2(s.first, t.first), level),
                     texelFetch(map, ivec2(s.second, t.first), level), s.fraction);
    vec4 lower = mix(texelFetch(map, ivec2(s.first, t.second), level),
                     texelFetch(map, ivec2(s.second, t.second), level), s.fraction);
    return mix(upper, lower, t.fraction);
}

vec4 trilinear(sampler2D map, int wrap_s, int wrap_t, vec2 at, float level) {
    int top = textureQueryLevels(map) - 1;
    float kept = min(level, float(top));
    int finer = int(kept);
    return mix(sampled_level(map, wrap_s, wrap_t, at, finer),
               sampled_level(map, wrap_s, wrap_t, at, min(finer + 1, top)), kept - float(finer));
}

vec4 filtered(sampler2D map, int wrap_s, int wrap_t, vec2 at, Footprint over) {
    if (over.probes == 1) return trilinear(map, wrap_s, wrap_t, at, over.level);
    vec4 sum = vec4(0);
    for (int i = 1; i <= int(over.probes); ++i)
        sum += trilinear(map, wrap_s, wrap_t,
                         at + (float(i) / (over.probes + 1) - 0.5) * over.along, over.level);
    return sum / over.probes;
}
