#version 450 core
// A texel of a shadow map: the distance from the light over the far plane's, where the caster's alpha
// mask leaves it standing.
#include mask.glsl

layout(location = 6) uniform float far;

in Surface { vec3 from_light; } surface;

void main() {
    if (is_left_out()) discard;
    gl_FragDepth = length(surface.from_light) / far;
}
