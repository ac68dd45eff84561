#version 450 core
// Lights what the spot's map shows to be nearest to the light, by two textures: the map, projected to
// s/r and t/r, and the ramp at the point's own depth. Their difference is that of two bytes.
#include lit_side.glsl
#include map_ramp.glsl

layout(binding = 2) uniform sampler2D map;

layout(location = 15) uniform float bias;
layout(location = 18) uniform mat3 map_from_world; // rows: right, up, forward

void main() {
    if (!may_be_lit()) discard;
    vec3 place = map_from_world * surface.from_light;
    // `right` and `up` are over the half side: a texture reaches from 0 to 1.
    vec3 projected = vec3(0.5 * (place.xy + place.z), place.z);
    float steps_behind = 255 * (step_at(place.z - bias) - textureProj(map, projected).r);
    if (ask_shadows && steps_behind > 0.5) discard;
    claim = 1;
}
