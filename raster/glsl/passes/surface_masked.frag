#version 450 core
// The visible surfaces, where their alpha mask leaves them standing.
#include surface.glsl
#include mask.glsl

void main() {
    if (is_left_out()) discard;
    keep_surface();
}
