#version 450 core
// All faces of a cube map in one pass: each triangle is sent to each layer.

layout(triangles) in;
layout(triangle_strip, max_vertices = 18) out;

layout(location = 20) uniform mat4 clip_from_light[6]; // of points relative to the light

in Surface { vec3 from_light; } corner[];
out Surface { vec3 from_light; } surface;
in Masked { vec2 at; } corner_masked[];
out Masked { vec2 at; } masked;

void main() {
    for (int face = 0; face < 6; ++face) {
        for (int k = 0; k < 3; ++k) {
            gl_Layer = face;
            gl_Position = clip_from_light[face] * vec4(corner[k].from_light, 1);
            surface.from_light = corner[k].from_light;
            masked.at = corner_masked[k].at;
            EmitVertex();
        }
        EndPrimitive();
    }
}
