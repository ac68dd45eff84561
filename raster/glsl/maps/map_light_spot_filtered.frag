#version 450 core
// Lights by a block of texels around the point's place in the spot's map, s/r and t/r.
#include lit_side.glsl
#include map_test.glsl

layout(binding = 2) uniform sampler2D map;

layout(location = 18) uniform mat3 map_from_world; // rows: right, up, forward

float stored_at(ivec2 texel) {
    return texelFetch(map, clamp(texel, 0, textureSize(map, 0).x - 1), 0).r;
}

#include map_block.glsl

void main() {
    if (!may_be_lit()) discard;
    claim = 1;
    if (!ask_shadows) return;
    vec3 place = map_from_world * surface.from_light;
    // `right` and `up` are over the half side: a texture reaches from 0 to 1.
    claim = claim_of_block(0.5 * (place.xy / place.z + 1) * textureSize(map, 0).x, place.z);
}
