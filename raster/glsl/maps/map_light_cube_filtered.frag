#version 450 core
// Lights by a block of texels around the point's place on the cube map's face that it lies on.
// Beyond the face's edges, either its outermost texels are repeated, or the block continues on the
// adjacent face. Hardware's own seamless lookups do that for blocks of 2 x 2 texels.
#include lit_side.glsl
#include map_test.glsl
#include cube_map.glsl

layout(binding = 2) uniform samplerCube map;

layout(location = 24) uniform bool seamless;

// Of the point.
int face;

// The vector with these components along the face's rows, down them and away from the light: the
// inverse of place_on_cube.
vec3 on_cube(float s, float t, float major) {
    float towards = (face & 1) == 0 ? 1 : -1;
    if (face < 2) return vec3(towards * major, -t, -towards * s);
    if (face < 4) return vec3(s, towards * major, towards * t);
    return vec3(towards * s, -t, towards * major);
}

// In units of half a texel the face is `size` away from the light, and its texels' centres lie
// between -size and size. What is beyond an edge is folded towards the light. Beyond two edges no
// texel lies: there the row is moved to the outermost.
float stored_at(ivec2 texel) {
    float size = float(textureSize(map, 0).x);
    float most = size - 1;
    vec2 along = 2 * vec2(texel) + 1 - size;
    if (!seamless) along = clamp(along, -most, most);
    if (abs(along.x) > size) along.y = clamp(along.y, -most, most);
    float beyond = max(max(abs(along.x), abs(along.y)) - size, 0);
    along = clamp(along, -size, size);
    return textureLod(map, on_cube(along.x, along.y, max(size - beyond, -most)), 0).r;
}

#include map_block.glsl

void main() {
    if (!may_be_lit()) discard;
    claim = 1;
    if (!ask_shadows) return;
    vec3 place = place_on_cube(surface.from_light);
    face = int(place.z);
    vec3 size = abs(surface.from_light);
    claim = claim_of_block(0.5 * (place.xy + 1) * textureSize(map, 0).x,
                           max(max(size.x, size.y), size.z));
}
