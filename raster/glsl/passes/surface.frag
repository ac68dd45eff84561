#version 450 core
// The visible surfaces.
#include surface.glsl

void main() {
    keep_surface();
}
