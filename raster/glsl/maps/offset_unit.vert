#version 450 core
// A triangle over the whole picture, halfway between the near and the far plane.

void main() {
    gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1);
}
