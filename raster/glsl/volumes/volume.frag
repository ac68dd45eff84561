#version 450 core
// The faces of the shadow volumes. A stencil buffer counts them itself; where a colour counts or
// shows them, each adds the number set for its side.

layout(location = 15) uniform vec2 worth; // of a front face, and of a back face

layout(location = 0) out float count;

void main() { count = gl_FrontFacing ? worth.x : worth.y; }
