// What is kept of a visible surface: shadowed until the light pass lights it.

// View depths; what lies outside is not drawn. Where lines of sight are parallel, w is 1: then all are
// let through, and the projection clips.
layout(location = 6) uniform vec2 visible_depths;
layout(location = 7) uniform uint first_triangle; // of this draw call

layout(location = 0) out float claim;
layout(location = 1) out uint triangle;

void keep_surface() {
    float view_depth = 1 / gl_FragCoord.w;
    if (view_depth < visible_depths.x || view_depth > visible_depths.y) discard;
    claim = 64.0 / 255.0;
    triangle = first_triangle + uint(gl_PrimitiveID);
}
