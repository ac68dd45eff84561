#version 450 core
// Lighting in eye space: the normal is perturbed there. `heights_in_space` is defined before this
// text: whether any material has heights in units of space.
#include lighting.glsl

// N' = N + h_u (N x P_v) + h_v (P_u x N), negated where the parametrization is mirrored, of a
// height field h on the surface P; u runs along P_u, v along P_v, which is up the picture. Both have
// the length 1: heights are in texels, which are squares.
vec3 perturbed_by_slopes(mat3 frame) {
    vec3 p_u = frame[0];
    vec3 p_v = frame[1];
    vec3 normal = frame[2];
    vec2 slope = slope();
    float h_u = slope.x;
    float h_v = -slope.y;
    return normal + surface.hand * (h_u * cross(normal, p_v) + h_v * cross(p_u, normal));
}

// The same with P_u and P_v of their true length, the sides of a texel on the triangle, over its
// area; here v runs down the picture, and the area's sign tells a mirrored one.
vec3 perturbed_over_true_lengths(vec3 normal) {
    vec2 slope = texel_side * slope();
    float area = dot(normal, cross(surface.texel_along, surface.texel_down));
    vec3 gradient = slope.x * cross(surface.texel_down, normal) +
                    slope.y * cross(normal, surface.texel_along);
    return area == 0 ? normal : normal - gradient / area;
}

vec3 perturbed_normal(mat3 frame) {
    vec3 normal = !has_slopes() ? frame * mapped_normal()
                  : heights_in_space && texel_side > 0 ? perturbed_over_true_lengths(frame[2])
                                   : perturbed_by_slopes(frame);
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
