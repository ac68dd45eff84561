// Lighting in the tangent space of the point, in which the map stores the perturbed normals.
#include lighting.glsl

// A vector in tangent space. On a back face it is negated instead of the normals.
vec3 carried(vec3 v, mat3 frame) {
    return seen_side() * (v * frame); // frame's transpose: its inverse
}

// The interpolated normal, not normalised.
vec3 mixed_normal() {
    if (!has_slopes()) return mapped_normal();
    vec2 slope = slope();
    return vec3(-slope.x, slope.y, 1);
}

// As used by graphics hardware before 2003: the interpolated normal is not normalised again. That
// hardware had no slopes in texels; a normal made of slopes is normalised.
vec3 hardware_normal() {
    return has_slopes() ? unit(mixed_normal()) : mixed_normal();
}
