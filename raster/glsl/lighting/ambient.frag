#version 450 core
// The visible surfaces under ambient light alone.
#include lighting.glsl

void main() {
    if (!is_seen()) discard;
    color = ambient_color * decal().rgb;
}
