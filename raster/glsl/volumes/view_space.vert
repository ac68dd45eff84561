#version 450 core
// Homogeneous points in view space: what the CPU has cut at the near plane.

layout(location = 0) in vec4 point;

layout(location = 0) uniform mat4 clip_from_view;

void main() {
    gl_Position = clip_from_view * point;
}
