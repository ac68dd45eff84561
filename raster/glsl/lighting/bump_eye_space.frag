#version 450 core
// Lighting in eye space: the normal is perturbed there.
#include lighting.glsl

// N' = N + h_u (N x P_v) + h_v (P_u x N), negated where the parametrization is mirrored, of a
// height field h on the surface P; u runs along P_u, v along P_v, which is up the picture.
vec3 perturbed_by_slopes(mat3 frame) {
    vec3 p_u = frame[0];
    vec3 p_v = frame[1];
    vec3 normal = frame[2];
    vec2 slope = slope();
    float h_u = slope.x;
    float h_v = -slope.y;
    return normal + surface.hand * (h_u * cross(normal, p_v) + h_v * cross(p_u, normal));
}

vec3 perturbed_normal(mat3 frame) {
    vec3 normal = has_slopes() ? perturbed_by_slopes(frame) : frame * mapped_normal();
    return dot(normal, normal) > 0 ? unit(normal) : frame[2];
}

void main() {
    if (!is_seen()) discard;
    mat3 frame = frame();
    vec3 l = light_direction();
    vec3 h = half_angle();
    vec3 normal = seen_side() * frame[2];
    vec3 perturbed = seen_side() * perturbed_normal(frame);
    color = lit_color(arriving_light(), dot(l, normal), dot(l, perturbed), dot(h, normal),
                      dot(h, perturbed));
}
