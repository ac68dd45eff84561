#version 450 core
// A quad for every edge, six vertices each. It is degenerate unless just one of the edge's
// triangles faces the light: then the corners that belong to the other go to infinity.
#include facing.glsl
#include pulled.glsl

struct Edge {
    uint low; // corners, low < high
    uint high;
    uint up;   // third corner of the triangle that runs the edge from low to high, or no_corner
    uint down; // and of the one that runs it back
};
const uint no_corner = 0xffffffffu;
layout(location = 12) uniform bool flipped; // only the quads that run down, wound as if they ran up
layout(std430, binding = 2) readonly buffer Edges { Edge edges[]; };

void main() {
    Edge edge = edges[gl_VertexID / 6];
    vec3 low = position_of(edge.low);
    vec3 high = position_of(edge.high);
    // A triangle that is missing never faces the light.
    bool up = edge.up != no_corner && faces(low, high, position_of(edge.up), light);
    bool down = edge.down != no_corner && faces(high, low, position_of(edge.down), light);
    // Low and high here and at infinity: 0, 1, 2, 3. Split as in raster/volumes/volume.cpp.
    const int side[6] = int[](1, 0, 2, 1, 2, 3);
    int which = side[gl_VertexID % 6];
    gl_Position = up == down || down != flipped
                      ? nowhere()
                      : projected((which & 1) != 0 ? edge.high : edge.low, which >= 2);
}
