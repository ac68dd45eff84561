#version 450 core
// The decals of what is seen.
#include lighting.glsl

void main() {
    if (!is_seen()) discard;
    color = decal().rgb;
}
