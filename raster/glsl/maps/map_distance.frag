#version 450 core
// A texel of a shadow map: the distance from the light over the far plane's.

layout(location = 6) uniform float far;

in Surface { vec3 from_light; } surface;

void main() {
    gl_FragDepth = length(surface.from_light) / far;
}
