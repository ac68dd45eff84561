#version 450 core
// Emits the caps of a triangle that faces the light, and a side over each edge whose other triangle
// does not. Where there is no other triangle, the index buffer names the triangle's own third
// corner again: that is the flipped triangle, which never faces the light when this one does.
#include facing.glsl

layout(triangles_adjacency) in;
layout(triangle_strip, max_vertices = 24) out;

layout(location = 8) uniform dvec3 light;
layout(location = 9) uniform bool light_cap;
layout(location = 10) uniform bool dark_cap;
layout(location = 12) uniform bool flipped; // only the sides that run down, wound as if they ran up

in Corner {
    vec3 world;
    vec4 here;
    vec4 at_infinity;
    flat int index;
} corner[];

invariant gl_Position;

void emit(vec4 a, vec4 b, vec4 c) {
    gl_Position = a;
    EmitVertex();
    gl_Position = b;
    EmitVertex();
    gl_Position = c;
    EmitVertex();
    EndPrimitive();
}

// The side over the edge from a to b of a triangle that faces the light: split as in
// raster/volumes/volume.cpp.
void emit_side(int a, int b) {
    bool up = corner[a].index < corner[b].index;
    if (up == flipped) return;
    int low = up ? a : b;
    int high = up ? b : a;
    vec4 far = corner[low].at_infinity;
    emit(corner[high].here, corner[low].here, far);
    emit(corner[high].here, far, corner[high].at_infinity);
}

void main() {
    if (!faces(corner[0].world, corner[2].world, corner[4].world, light)) return;
    if (light_cap) emit(corner[0].here, corner[2].here, corner[4].here);
    if (dark_cap) emit(corner[4].at_infinity, corner[2].at_infinity, corner[0].at_infinity);
    for (int k = 0; k < 6; k += 2) {
        int a = k;
        int b = (k + 2) % 6;
        if (!faces(corner[b].world, corner[a].world, corner[k + 1].world, light)) emit_side(a, b);
    }
}
