#version 450 core
// For volumes made by a geometry shader: each vertex at its position, and at infinity. The products
// are those of project.vert, so that a light cap has its surface's depth bit for bit.

layout(location = 0) in vec3 position;

layout(location = 0) uniform mat4 clip_from_relative;
layout(location = 1) uniform vec3 origin_high; // of the relative coordinates: the eye, or zero
layout(location = 2) uniform vec3 origin_low;  // the remainder of its rounding to float
layout(location = 3) uniform vec3 light_high;
layout(location = 4) uniform vec3 light_low;
layout(location = 11) uniform float light_w; // 0: light_high and light_low are the direction to it

layout(location = 35) uniform float end_w; // w at infinity (ClipTransform)

out Corner {
    vec3 world;
    vec4 here;
    vec4 at_infinity;
    flat int index;
} corner;

invariant gl_Position;

void main() {
    precise vec3 relative = (position - origin_high) - origin_low;
    precise vec3 away = (light_w * position - light_high) - light_low;
    corner.world = position;
    corner.at_infinity = clip_from_relative * vec4(away, end_w);
    corner.index = gl_VertexID;
    gl_Position = clip_from_relative * vec4(relative, 1);
    corner.here = gl_Position;
}
