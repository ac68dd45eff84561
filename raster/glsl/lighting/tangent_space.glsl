// Lighting in the tangent space of the point, in which the map stores the perturbed normals.
// `vectors`, a value of VectorOrigin, is defined before this text.
#include lighting.glsl

const int vectors_per_pixel = 0;

// A vector in tangent space. On a back face it is negated instead of the normals.
vec3 carried(vec3 v, mat3 frame) {
    return seen_side() * (v * frame); // frame's transpose: its inverse
}

// One that was carried at the vertices, interpolated and normalised. Of a surface without a bump
// map, which has no tangent space, it was not.
vec3 carried_at_vertices(vec3 interpolated) {
    vec3 v = normalised(interpolated);
    return bump_form == 0 ? carried(v, frame()) : seen_side() * v;
}

// L and H.
vec3 carried_light() {
    return vectors == vectors_per_pixel ? carried(light_direction(), frame())
                                        : carried_at_vertices(surface.vertex_light);
}
vec3 carried_half() {
    return vectors == vectors_per_pixel ? carried(half_angle(), frame())
                                        : carried_at_vertices(surface.vertex_half);
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
