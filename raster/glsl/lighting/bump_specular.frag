#version 450 core
// The specular term, in tangent space. The pass binds the half-angle vector alone, so that the
// highlight is dimmed by its self-shadowing, whatever the rule asks for.
#include tangent_space.glsl

void main() {
    if (!is_seen()) discard;
    vec3 h = carried_half();
    float specular = self_shadow(h.z) * specular_power(max(0, dot(h, hardware_normal())));
    color = arriving_light() * (specular * decal().a * specular_color);
}
