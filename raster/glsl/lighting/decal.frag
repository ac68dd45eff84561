#version 450 core
// The decals of the visible surfaces.
#include lighting.glsl

void main() {
    if (!is_seen()) discard;
    color = decal().rgb;
}
