#version 450 core
// The specular term, in tangent space.
#include tangent_space.glsl

void main() {
    if (!is_seen()) discard;
    vec3 h = carried(half_angle(), frame());
    float specular = specular_term(h.z, dot(h, hardware_normal()));
    color = arriving_light() * (specular * decal().a * specular_color);
}
