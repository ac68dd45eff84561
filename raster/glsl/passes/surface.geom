#version 450 core
// Draws surfaces through a geometry shader, for volumes that are made by one. After a geometry
// shader the driver may round the viewport transform differently than after a vertex shader
// (llvmpipe does where half the picture's width is no power of two), and a light cap must have its
// surface's depth bit for bit.

layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;

in Surface { vec3 from_light; } corner[];
out Surface { vec3 from_light; } surface;
in Masked { vec2 at; } corner_masked[];
out Masked { vec2 at; } masked;
in Depth { float in_clip; } corner_depth[];
out Depth { float in_clip; } depth;

invariant gl_Position;

void main() {
    for (int k = 0; k < 3; ++k) {
        gl_Position = gl_in[k].gl_Position;
        gl_PrimitiveID = gl_PrimitiveIDIn;
        surface.from_light = corner[k].from_light;
        masked.at = corner_masked[k].at;
        depth.in_clip = corner_depth[k].in_clip;
        EmitVertex();
    }
    EndPrimitive();
}
