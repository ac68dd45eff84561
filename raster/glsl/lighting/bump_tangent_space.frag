#version 450 core
// Lighting in the tangent space of the point: light and half-angle vector are transformed to it,
// and the normal map is used as it is.
#include tangent_space.glsl

vec3 perturbed_normal() {
    vec3 normal = mixed_normal();
    return dot(normal, normal) > 0 ? unit(normal) : vec3(0, 0, 1);
}

void main() {
    if (!is_seen()) discard;
    vec3 l = carried_light();
    vec3 h = carried_half();
    vec3 normal = perturbed_normal();
    color = lit_color(arriving_light(), l.z, dot(l, normal), h.z, dot(h, normal));
}
