// Lighting in the tangent space of the point, where the small normals are as the map has them.
#include lighting.glsl

// On the back seen from the eye, turned over in place of the normals.
vec3 carried(vec3 v, mat3 frame) {
    return seen_side() * (v * frame); // frame's transpose: its inverse
}

// As the texels were mixed, not of unit length.
vec3 mixed_normal() {
    if (!has_slopes()) return mapped_normal();
    vec2 slope = slope();
    return vec3(-slope.x, slope.y, 1);
}

// As graphics hardware before 2003 used it: what was mixed is not made of unit length again. It had
// no slopes in texels, of which the normal is.
vec3 hardware_normal() {
    return has_slopes() ? unit(mixed_normal()) : mixed_normal();
}
