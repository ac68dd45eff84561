#version 450 core
// The picture as seen from the light through the near plane: each point is projected to where its
// shadow falls on that plane, if it lies on the light's side of it.

layout(location = 0) in vec3 position;

// Row z: how far a point lies on the light's side of the near plane.
layout(location = 0) uniform mat4 clip_from_relative;
layout(location = 1) uniform vec3 origin_high; // of the relative coordinates: the light, or the eye
layout(location = 2) uniform vec3 origin_low;

out float gl_ClipDistance[1];

void main() {
    precise vec3 relative = (position - origin_high) - origin_low;
    vec4 projected = clip_from_relative * vec4(relative, 1);
    gl_ClipDistance[0] = projected.z;
    gl_Position = vec4(projected.xy, 0, projected.w);
}
