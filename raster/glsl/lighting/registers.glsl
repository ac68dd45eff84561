// What register combiners (NV_register_combiners) compute with. A register holds 8 bits and a sign,
// within [-1, 1], and each stage reads what the one before wrote. Names are the extension's.

// A number as a register holds it.
float q(float x) {
    return clamp(floor(255 * x + 0.5) / 255, -1, 1);
}
vec3 q(vec3 x) {
    return clamp(floor(255 * x + 0.5) / 255, -1, 1);
}

// The input mapping "unsigned identity".
float max0(float x) {
    return max(0, x);
}

// Numbers in [0, 1] as a texture's bytes hold them.
vec4 in_bytes(vec4 t) {
    return clamp(floor(255 * t + 0.5) / 255, 0, 1);
}

// A vector in a texture's bytes, by the input mapping "expand normal": 0 becomes 1/255.
vec3 expanded_bytes(vec3 v) {
    return q(2 * in_bytes(vec4(0.5 + 0.5 * v, 0)).rgb - 1);
}
