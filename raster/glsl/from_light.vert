#version 450 core
// The picture as the light sees it through the near plane: each point where its shadow falls on
// that plane, as long as it lies between the two.

layout(location = 0) in vec3 position;

layout(location = 0) uniform mat4 clip_from_relative; // w: distance from the light, along the view
layout(location = 1) uniform vec3 origin_high;        // of the relative coordinates: the eye
layout(location = 2) uniform vec3 origin_low;
layout(location = 8) uniform float near_plane; // its distance from the light, along the view

out float gl_ClipDistance[1];

void main() {
    precise vec3 relative = (position - origin_high) - origin_low;
    gl_Position = clip_from_relative * vec4(relative, 1);
    gl_ClipDistance[0] = near_plane - gl_Position.w;
}
