#version 450 core
// A texel of a shadow map: the ramp's step in which the depth lies, in a byte of colour.
#include map_ramp.glsl

layout(location = 18) uniform mat3 map_from_world; // rows: right, up, forward

in Surface { vec3 from_light; } surface;

layout(location = 0) out float value;

void main() {
    value = step_at((map_from_world * surface.from_light).z);
}
