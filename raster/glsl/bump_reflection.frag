#version 450 core
// What the surface reflects of the environment, looked up along the eye's direction mirrored at the
// small normal, in world space.
#include tangent_space.glsl

layout(binding = 5) uniform sampler2DArray environment;

vec3 small_normal(mat3 frame) {
    vec3 normal = mixed_normal();
    return seen_side() * (frame * (dot(normal, normal) > 0 ? unit(normal) : vec3(0, 0, 1)));
}

vec3 mirrored_at(vec3 normal, vec3 v) {
    return 2 * dot(normal, v) * normal - v;
}

void main() {
    if (!is_seen()) discard;
    vec3 r = mirrored_at(small_normal(frame()), unit(-surface.from_eye));
    color = reflectance * decal().a * sampled_on_cube(environment, r);
}
