#version 450 core
// A texel of a shadow map: the window depth, which needs no shader.

void main() {}
