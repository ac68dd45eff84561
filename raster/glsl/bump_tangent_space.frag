#version 450 core
// Lighting in the tangent space of the point: light and half-angle vector are carried into it, and
// the normal map is used as it is.
#include lighting.glsl

vec3 small_normal() {
    vec3 normal;
    if (bump == bump_height_field) {
        vec2 slope = slope();
        normal = vec3(-slope.x, slope.y, 1);
    } else {
        normal = mapped_normal();
    }
    return dot(normal, normal) > 0 ? unit(normal) : vec3(0, 0, 1);
}

void main() {
    if (!is_seen()) discard;
    mat3 frame = frame();
    vec3 to_light = unit(surface.to_light);
    vec3 half_angle = unit(to_light - unit(surface.from_eye));
    vec3 l = seen_side() * (to_light * frame); // frame's transpose: its inverse
    vec3 h = seen_side() * (half_angle * frame);
    vec3 normal = small_normal();
    color = lit_color(light_from(to_light), l.z, dot(l, normal), h.z, dot(h, normal));
}
