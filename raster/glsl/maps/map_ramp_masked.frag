#version 450 core
// A texel of a shadow map: the ramp's step in which the depth lies, where the caster's alpha mask
// leaves it standing.
#include map_ramp.glsl
#include mask.glsl

layout(location = 18) uniform mat3 map_from_world; // rows: right, up, forward

in Surface { vec3 from_light; } surface;

layout(location = 0) out float value;

void main() {
    if (is_left_out()) discard;
    value = step_at((map_from_world * surface.from_light).z);
}
