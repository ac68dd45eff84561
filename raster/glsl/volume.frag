#version 450 core
// The faces of the shadow volumes leave nothing but their count in the stencil buffer.

void main() {}
