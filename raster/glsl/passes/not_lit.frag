#version 450 core
// What the claim does not show as lit; for the stencil.

layout(binding = 0) uniform sampler2D claim;

void main() {
    if (texelFetch(claim, ivec2(gl_FragCoord.xy), 0).r == 1) discard;
}
