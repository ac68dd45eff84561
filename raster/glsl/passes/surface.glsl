// What is kept of a visible surface: shadowed until the light pass lights it.

// What lies outside is not drawn: view depths or, where lines of sight are parallel and w tells
// nothing, z of the clip coordinates.
layout(location = 6) uniform vec2 visible_depths;
layout(location = 8) uniform bool tells_by_clip;
layout(location = 7) uniform uint first_triangle; // of this draw call

in Depth { float in_clip; } depth;

layout(location = 0) out float claim;
layout(location = 1) out uint triangle;

void keep_surface() {
    float here = tells_by_clip ? depth.in_clip : 1 / gl_FragCoord.w;
    if (here < visible_depths.x || here > visible_depths.y) discard;
    claim = 64.0 / 255.0;
    triangle = first_triangle + uint(gl_PrimitiveID);
}
