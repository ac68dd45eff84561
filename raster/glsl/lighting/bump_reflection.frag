#version 450 core
// The surface's reflection of the environment, looked up along the eye's direction mirrored at the
// perturbed normal, in world space.
#include tangent_space.glsl

layout(binding = 5) uniform sampler2DArray environment;

vec3 perturbed_normal(mat3 frame) {
    vec3 normal = mixed_normal();
    return seen_side() * (frame * (dot(normal, normal) > 0 ? unit(normal) : vec3(0, 0, 1)));
}

vec3 mirrored_at(vec3 normal, vec3 v) {
    return 2 * dot(normal, v) * normal - v;
}

void main() {
    if (!is_seen()) discard;
    vec3 r = mirrored_at(perturbed_normal(frame()), unit(-surface.from_eye));
    color = reflectance * decal().a * sampled_on_cube(environment, r);
}
