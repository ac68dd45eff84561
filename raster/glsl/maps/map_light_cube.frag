#version 450 core
// Lights what the cube map shows to be nearest to the light.
#include lit_side.glsl
#include map_test.glsl

layout(binding = 2) uniform samplerCube map;

void main() {
    if (!may_be_lit()) discard;
    vec3 size = abs(surface.from_light);
    float depth = max(max(size.x, size.y), size.z);
    if (ask_shadows && is_shadowed(texture(map, surface.from_light).r, depth)) discard;
    claim = 1;
}
