#version 450 core
// Lights what the sun's map shows to be nearest to the light: a texture in parallel projection.
#include lit_side.glsl
#include map_test.glsl

layout(binding = 2) uniform sampler2D map;

layout(location = 18) uniform mat3 map_from_world; // rows: right, up, forward

void main() {
    if (!may_be_lit()) discard;
    // Of the light's camera: what comes from the vertex shader is relative to its eye.
    vec3 place = map_from_world * surface.from_light;
    // `right` and `up` are over the half side: a texture reaches from 0 to 1.
    if (ask_shadows && is_shadowed(texture(map, 0.5 * (place.xy + 1)).r, place.z)) discard;
    claim = 1;
}
