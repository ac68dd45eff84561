#version 450 core
// Lights by a block of texels around the point's place in the spot's map, s/r and t/r. Either each is
// compared, and the claim is the share of them that says lit (percentage-closer filtering); or their
// mean is compared once.
#include lit_side.glsl
#include map_test.glsl

layout(binding = 2) uniform sampler2D map;

layout(location = 18) uniform mat3 map_from_world; // rows: right, up, forward
layout(location = 21) uniform int side;            // texels a side of the block
layout(location = 22) uniform bool averages_values;

void main() {
    if (!may_be_lit()) discard;
    claim = 1;
    if (!ask_shadows) return;
    vec3 place = map_from_world * surface.from_light;
    int size = textureSize(map, 0).x;
    // `right` and `up` are over the half side: a texture reaches from 0 to 1.
    vec2 texel = 0.5 * (place.xy / place.z + 1) * size;
    ivec2 first = ivec2(floor(texel - 0.5 * float(side - 1)));
    int lit = 0;
    float sum = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            float stored = texelFetch(map, clamp(first + ivec2(x, y), 0, size - 1), 0).r;
            sum += stored;
            if (!is_shadowed(stored, place.z)) ++lit;
        }
    int all = side * side;
    if (averages_values) lit = is_shadowed(sum / all, place.z) ? 0 : all;
    if (lit == 0) discard;
    // The bytes between shadowed and lit are free for shares: see map_shadows.cpp.
    if (lit < all) claim = float(64 + lit) / 255;
}
