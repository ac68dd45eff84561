#version 450 core
// Every triangle once as a light cap and, after all of those, once as a dark cap; degenerate where
// its front does not face the light.
#include facing.glsl
#include pulled.glsl

layout(location = 9) uniform int first_dark; // vertices from here on are the dark caps'
layout(std430, binding = 2) readonly buffer Corners { uint corners[]; };

void main() {
    bool dark = gl_VertexID >= first_dark;
    int vertex = dark ? gl_VertexID - first_dark : gl_VertexID;
    int first = vertex - vertex % 3;
    uint a = corners[first];
    uint b = corners[first + 1];
    uint c = corners[first + 2];
    // A dark cap is wound in reverse.
    uint own = corners[dark ? first + 2 - vertex % 3 : vertex];
    gl_Position = faces(position_of(a), position_of(b), position_of(c), light)
                      ? projected(own, dark) : nowhere();
}
