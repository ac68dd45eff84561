#version 450 core
// A quad for every edge, six vertices each, without an extent until the light sees one of the
// edge's triangles and not the other: then the corners that belong to the other go to infinity.
#include facing.glsl
#include pulled.glsl

struct Edge {
    uint low; // corners, low < high
    uint high;
    uint up;   // third corner of the triangle that runs the edge from low to high
    uint down; // and of the one that runs it back; each the other's where there is none
};
layout(std430, binding = 2) readonly buffer Edges { Edge edges[]; };

void main() {
    Edge edge = edges[gl_VertexID / 6];
    vec3 low = position_of(edge.low);
    vec3 high = position_of(edge.high);
    bool up = faces(low, high, position_of(edge.up), light);
    bool down = faces(high, low, position_of(edge.down), light);
    // Low and high here and at infinity: 0, 1, 2, 3. Cut as raster/volume.cpp does.
    const int sides_up[6] = int[](1, 0, 2, 1, 2, 3);
    const int sides_down[6] = int[](0, 1, 2, 2, 1, 3);
    int k = gl_VertexID % 6;
    int which = up ? sides_up[k] : sides_down[k];
    gl_Position = up == down ? nowhere()
                             : projected((which & 1) != 0 ? edge.high : edge.low, which >= 2);
}
