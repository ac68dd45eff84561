#version 450 core
// Lights surfaces that were drawn through a geometry shader (surface.geom): their depths must be the
// same, bit for bit.

layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;

in Surface {
    vec3 from_eye;
    vec3 to_light;
    vec3 normal;
    vec3 tangent;
    vec3 vertex_light;
    vec3 vertex_half;
    vec2 decal_at;
    vec2 bump_at;
    flat vec3 texel_along;
    flat vec3 texel_down;
    flat float hand;
    flat uint triangle;
} corner[];

out Surface {
    vec3 from_eye;
    vec3 to_light;
    vec3 normal;
    vec3 tangent;
    vec3 vertex_light;
    vec3 vertex_half;
    vec2 decal_at;
    vec2 bump_at;
    flat vec3 texel_along;
    flat vec3 texel_down;
    flat float hand;
    flat uint triangle;
} surface;

invariant gl_Position;

void main() {
    for (int k = 0; k < 3; ++k) {
        gl_Position = gl_in[k].gl_Position;
        surface.from_eye = corner[k].from_eye;
        surface.to_light = corner[k].to_light;
        surface.normal = corner[k].normal;
        surface.tangent = corner[k].tangent;
        surface.vertex_light = corner[k].vertex_light;
        surface.vertex_half = corner[k].vertex_half;
        surface.decal_at = corner[k].decal_at;
        surface.bump_at = corner[k].bump_at;
        surface.texel_along = corner[k].texel_along;
        surface.texel_down = corner[k].texel_down;
        surface.hand = corner[k].hand;
        surface.triangle = corner[k].triangle;
        EmitVertex();
    }
    EndPrimitive();
}
