// Vertices that a shader fetches by their numbers, transformed as in project.vert.

layout(std430, binding = 1) readonly buffer Positions { float coordinates[]; };

layout(location = 0) uniform mat4 clip_from_relative;
layout(location = 1) uniform vec3 origin_high; // of the relative coordinates: the eye, or zero
layout(location = 2) uniform vec3 origin_low;  // the remainder of its rounding to float
layout(location = 3) uniform vec3 light_high;
layout(location = 4) uniform vec3 light_low;
layout(location = 35) uniform float end_w; // w at infinity (ClipTransform)
layout(location = 8) uniform dvec3 light;

invariant gl_Position;

vec3 position_of(uint vertex) {
    return vec3(coordinates[3 * vertex], coordinates[3 * vertex + 1], coordinates[3 * vertex + 2]);
}

vec4 projected(uint vertex, bool at_infinity) {
    vec3 position = position_of(vertex);
    precise vec3 relative = (position - origin_high) - origin_low;
    precise vec3 away = (light_w * position - light_high) - light_low;
    return clip_from_relative * (at_infinity ? vec4(away, end_w) : vec4(relative, 1));
}

// A corner of a face that is not drawn: all its corners coincide outside of the clip volume.
vec4 nowhere() {
    return vec4(2, 2, 2, 1);
}
