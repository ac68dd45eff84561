#version 450 core
// Corners with their lighting attributes, three per triangle. Their place in the picture is
// project.vert's, bit for bit; all that is interpolated is linear over a triangle. `vectors`, a
// value of VectorOrigin, is defined before this text.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent; // w: the handedness of the frame
layout(location = 3) in vec2 decal_at;
layout(location = 4) in vec2 bump_at;
layout(location = 5) in vec3 texel_along; // the sides of the triangle's texels; only where heights
layout(location = 6) in vec3 texel_down;  // are in units of space

layout(location = 0) uniform mat4 clip_from_relative;
layout(location = 1) uniform vec3 origin_high; // of the relative coordinates: the eye, or the world's
layout(location = 2) uniform vec3 origin_low;  // the remainder of its rounding to float
layout(location = 28) uniform vec3 eye_high;
layout(location = 29) uniform vec3 eye_low;
layout(location = 36) uniform float eye_w; // 0: eye_high and eye_low are the direction to it
layout(location = 3) uniform vec3 light_high;
layout(location = 4) uniform vec3 light_low;
layout(location = 11) uniform float light_w; // 0: light_high and light_low are the direction to it
layout(location = 5) uniform mat3 lit_from_world; // the axes in which the technique lights
layout(location = 9) uniform int bump_form;       // a value of BumpForm; 0 without a map

out Surface {
    vec3 from_eye; // neither these two nor the next are normalised
    vec3 to_light;
    vec3 normal;
    vec3 tangent;
    vec3 vertex_light; // L and H, where they are made at vertices
    vec3 vertex_half;
    vec2 decal_at;
    vec2 bump_at;
    flat vec3 texel_along;
    flat vec3 texel_down;
    flat float hand;
    flat uint triangle;
} surface;

invariant gl_Position;

const int vectors_per_pixel = 0;
const int vectors_unit_at_vertices = 2;

#include unit.glsl

// Carries L and H into the vertex's tangent space. A surface without a bump map has none: there they
// stay in the axes of lighting.
void make_vectors(vec3 to_light, vec3 to_eye) {
    vec3 half_angle = unit(to_light) + unit(to_eye);
    bool make_unit = vectors == vectors_unit_at_vertices;
    vec3 light = make_unit ? unit(to_light) : to_light;
    if (make_unit) half_angle = unit(half_angle);
    vec3 n = unit(surface.normal);
    vec3 t = unit(surface.tangent - n * dot(n, surface.tangent));
    mat3 frame = bump_form == 0 ? mat3(1) : mat3(t, tangent.w * cross(n, t), n);
    surface.vertex_light = light * frame; // by the transpose: the inverse
    surface.vertex_half = half_angle * frame;
}

void main() {
    precise vec3 relative = (position - origin_high) - origin_low;
    precise vec3 away = (light_w * position - light_high) - light_low;
    precise vec3 from_eye = (eye_w * position - eye_high) - eye_low;
    surface.from_eye = lit_from_world * from_eye;
    surface.to_light = lit_from_world * -away;
    surface.normal = lit_from_world * normal;
    surface.tangent = lit_from_world * tangent.xyz;
    if (vectors != vectors_per_pixel) make_vectors(surface.to_light, -surface.from_eye);
    surface.decal_at = decal_at;
    surface.bump_at = bump_at;
    surface.texel_along = lit_from_world * texel_along;
    surface.texel_down = lit_from_world * texel_down;
    surface.hand = tangent.w;
    surface.triangle = uint(gl_VertexID) / 3;
    gl_Position = clip_from_relative * vec4(relative, 1);
}
