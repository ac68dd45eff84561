#version 450 core
// The ambient light on the visible surfaces, before any decal.
#include lighting.glsl

void main() {
    if (!is_seen()) discard;
    color = ambient_color;
}
