// Which fragments of the lit sides the light pass may light, shadows aside. Of two triangles with
// equal depth only the visible one counts.

layout(binding = 0) uniform usampler2D seen_triangle;
layout(std430, binding = 0) readonly buffer LitSides { uint triangle_drawn[]; };

layout(location = 7) uniform uint first_side; // of this draw call
layout(location = 12) uniform bool ask_shadows; // in this shader, where no stencil tells of them
layout(location = 13) uniform vec3 cone_axis;
layout(location = 14) uniform float cone_cosine; // below -1: the light shines everywhere

in Surface { vec3 from_light; } surface;

layout(location = 0) out float claim;

bool may_be_lit() {
    uint seen = texelFetch(seen_triangle, ivec2(gl_FragCoord.xy), 0).r;
    if (seen != triangle_drawn[first_side + gl_PrimitiveID]) return false;
    // A spot lights what lies within its outer cone.
    return dot(surface.from_light, cone_axis) >= cone_cosine * length(surface.from_light);
}
