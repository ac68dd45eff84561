#version 450 core
// All of the lighting in one pass, as register combiners compute it.
#include tangent_space.glsl
#include combiners.glsl

void main() {
    if (!is_seen()) discard;
    mat3 frame = frame();
    vec3 l = carried(light_direction(), frame);
    vec3 h = carried(half_angle(), frame);
    vec3 light = arriving_light();
    color = combined(hardware_normal(), l, h, decal(), light, specular_color * light,
                     ambient_color);
}
