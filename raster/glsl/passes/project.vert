#version 450 core
// The vertex shader shared by the passes: what coincides in the scene coincides in depth, bit for
// bit. Vertices [0, finite_vertices) are the scene's; those after them are the same, moved away
// from the light to infinity.

layout(location = 0) in vec3 position;
layout(location = 1) in vec2 mask_at; // of the scene's vertices, where it has masks

layout(location = 0) uniform mat4 clip_from_relative;
layout(location = 1) uniform vec3 origin_high; // of the relative coordinates: the eye, or zero
layout(location = 2) uniform vec3 origin_low;  // the remainder of its rounding to float
layout(location = 3) uniform vec3 light_high;
layout(location = 4) uniform vec3 light_low;
layout(location = 11) uniform float light_w; // 0: light_high and light_low are the direction to it
layout(location = 35) uniform float end_w; // w at infinity (ClipTransform)
layout(location = 5) uniform int finite_vertices;

out Surface {
    vec3 from_light; // of the scene's vertices; zero minus the direction where w = 0
} surface;

out Masked { vec2 at; } masked;

out Depth { float in_clip; } depth;

invariant gl_Position;

void main() {
    precise vec3 relative = (position - origin_high) - origin_low;
    precise vec3 away = (light_w * position - light_high) - light_low;
    surface.from_light = away;
    masked.at = mask_at;
    gl_Position =
        clip_from_relative * (gl_VertexID < finite_vertices ? vec4(relative, 1) : vec4(away, end_w));
    depth.in_clip = gl_Position.z;
}
