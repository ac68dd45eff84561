#version 450 core
// A texel of a shadow map: the window depth, where the caster's alpha mask leaves it standing.
#include mask.glsl

void main() {
    if (is_left_out()) discard;
}
