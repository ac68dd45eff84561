// Normalises vectors in the way set for the technique; a zero vector stays zero.
#include unit.glsl
#include cube_map.glsl

layout(binding = 3) uniform sampler2DArray unit_vectors; // normalisation_cube.h, one layer per face

// `normalisation`, a value of Normalisation, and `newton_steps` are defined before this text.

const int normalisation_cube_map = 1;
const int normalisation_newton_raphson = 2;

// 1 / sqrt(x): an estimate from the float's bits and steps of Newton's method. After one step its
// relative error is at most 0.0017523 (Lomont 2003), apart from the rounding of floats.
float reciprocal_root(float x) {
    float y = uintBitsToFloat(0x5f3759dfu - (floatBitsToUint(x) >> 1));
    for (int step = 0; step < newton_steps; ++step) y *= 1.5 - 0.5 * x * y * y;
    return y;
}

vec3 looked_up(vec3 v) {
    return v == vec3(0) ? vec3(0) : 2 * sampled_on_cube(unit_vectors, v) - 1;
}

vec3 normalised(vec3 v) {
    if (normalisation == normalisation_cube_map) return looked_up(v);
    if (normalisation == normalisation_newton_raphson) return reciprocal_root(dot(v, v)) * v;
    return unit(v);
}
