#version 450 core
// What is seen under ambient light alone.
#include lighting.glsl

void main() {
    if (!is_seen()) discard;
    color = ambient_color * decal().rgb;
}
