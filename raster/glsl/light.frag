#version 450 core
// Lights the surfaces that pass the shadow test. Of two triangles with equal depth only the visible
// one counts.

layout(binding = 0) uniform usampler2D seen_triangle;
layout(binding = 1) uniform sampler2D counter; // where a colour counts in place of the stencil
layout(std430, binding = 0) readonly buffer LitSides { uint triangle_drawn[]; };

layout(location = 7) uniform uint first_side; // of this draw call
layout(location = 13) uniform vec3 cone_axis;
layout(location = 12) uniform bool ask_counter;
layout(location = 14) uniform float cone_cosine; // below -1: the light shines everywhere

in Surface { vec3 from_light; } surface;

layout(location = 0) out float claim;

void main() {
    uint seen = texelFetch(seen_triangle, ivec2(gl_FragCoord.xy), 0).r;
    if (seen != triangle_drawn[first_side + gl_PrimitiveID]) discard;
    if (ask_counter && texelFetch(counter, ivec2(gl_FragCoord.xy), 0).r != 0) discard;
    // A spot lights what lies within its outer cone.
    if (dot(surface.from_light, cone_axis) < cone_cosine * length(surface.from_light)) discard;
    claim = 1;
}
