// The comparison with a texel of a shadow map, in world units.

layout(location = 15) uniform float bias;
layout(location = 16) uniform vec2 planes; // near and far of the light's camera
layout(location = 17) uniform bool holds_distances;
layout(location = 23) uniform bool is_parallel; // the light's camera

// `stored`: the texel. `depth`: the point's depth from the light's camera.
bool is_shadowed(float stored, float depth) {
    if (holds_distances) return stored * planes.y + bias < length(surface.from_light);
    float nearer = depth - bias;
    if (is_parallel) return stored < (nearer - planes.x) / (planes.y - planes.x);
    if (nearer <= planes.x) return false;
    return stored < planes.y / (planes.y - planes.x) * (1 - planes.x / nearer);
}
