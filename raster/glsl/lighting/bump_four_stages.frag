#version 450 core
// All of the lighting in one pass, as four combiner stages compute it.
#include tangent_space.glsl
#include four_stages.glsl

void main() {
    if (!is_seen()) discard;
    vec3 l = carried_light();
    vec3 h = carried_half();
    vec3 light = arriving_light();
    if (light == vec3(0)) discard; // outside a spot's cone, where the ambient light stays as it is
    color = combined(hardware_normal(), l, h, decal(), light, specular_color * light,
                     ambient_color);
}
