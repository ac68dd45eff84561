// A ramp of 256 equal steps from the near to the far plane of the light's camera, as a texture whose
// texels are their own number: what old hardware had to compare depths with.

layout(location = 16) uniform vec2 planes;

layout(binding = 3) uniform sampler2D ramp; // one row

float step_at(float depth) {
    return texture(ramp, vec2((depth - planes.x) / (planes.y - planes.x), 0.5)).r;
}
