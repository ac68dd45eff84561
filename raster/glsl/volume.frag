#version 450 core
// The faces of the shadow volumes. A stencil buffer counts them by itself; where a colour counts
// them, or shows them, each adds what its side says.

layout(location = 15) uniform vec2 worth; // of a front face, and of a back face

layout(location = 0) out float count;

void main() { count = gl_FrontFacing ? worth.x : worth.y; }
