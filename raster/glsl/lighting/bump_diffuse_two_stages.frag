#version 450 core
// Ambient and diffuse light, in tangent space and before any decal, by two combiner stages.
#include tangent_space.glsl
#include two_stages.glsl

void main() {
    if (!is_seen()) discard;
    color = diffuse_pass(hardware_normal(), carried_light(), arriving_light(), ambient_color);
}
