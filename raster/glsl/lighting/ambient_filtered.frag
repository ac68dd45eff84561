#version 450 core
// The visible surfaces under ambient light alone, their decals filtered over the pixel.
#include filtered.glsl

void main() {
    Steps steps = steps_of(surface.decal_at);
    if (!is_seen()) discard;
    color = ambient_color * filtered_decal(steps).rgb;
}
