#version 450 core
// Ambient and diffuse light, in tangent space and before any decal.
#include tangent_space.glsl

void main() {
    if (!is_seen()) discard;
    vec3 l = carried_light();
    color = ambient_color + arriving_light() * diffuse_term(l.z, dot(l, hardware_normal()));
}
