#version 450 core
// Keeps what the spot's map shows to be shadowed, for the stencil buffer: a projected texture, looked
// up at s/r and t/r.
#include lit_side.glsl
#include map_test.glsl

layout(binding = 2) uniform sampler2D map;

layout(location = 18) uniform mat3 map_from_world; // rows: right, up, forward

void main() {
    if (!may_be_lit()) discard;
    vec3 place = map_from_world * surface.from_light;
    // `right` and `up` are over the half side: a texture reaches from 0 to 1.
    vec3 projected = vec3(0.5 * (place.xy + place.z), place.z);
    if (!is_shadowed(textureProj(map, projected).r, place.z)) discard;
}
