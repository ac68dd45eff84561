#version 450 core
// Lights the surfaces that pass the shadow test, in the stencil or in a colour that counts.
#include lit_side.glsl

layout(binding = 1) uniform sampler2D counter;

void main() {
    if (!may_be_lit()) discard;
    if (ask_shadows && texelFetch(counter, ivec2(gl_FragCoord.xy), 0).r != 0) discard;
    claim = 1;
}
