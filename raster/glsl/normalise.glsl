// Vectors made of unit length, in the way that the technique is set to; zero where they are zero.

layout(binding = 3) uniform sampler2DArray unit_vectors; // normalisation_cube.h, a face a layer

// `normalisation`, a value of Normalisation, is defined in front of this.

const int normalisation_cube_map = 1;
const int normalisation_newton_raphson = 2;

vec3 unit(vec3 v) {
    float square = dot(v, v);
    return square > 0 ? v / sqrt(square) : vec3(0);
}

// 1 / sqrt(x): a guess by the float's bits and one step of Newton's. Its relative error is at most
// 0.0017523 (Lomont 2003), but for the rounding of floats.
float reciprocal_root(float x) {
    float y = uintBitsToFloat(0x5f3759dfu - (floatBitsToUint(x) >> 1));
    return y * (1.5 - 0.5 * x * y * y);
}

// The face that a vector looks at, and where: along its rows and down them, in [-1, 1] (OpenGL 4.5,
// table 8.19). Of components of equal size x goes before y before z.
vec3 place_on_cube(vec3 v) {
    vec3 size = abs(v);
    if (size.x >= size.y && size.x >= size.z)
        return vec3(vec2(v.x < 0 ? v.z : -v.z, -v.y) / size.x, v.x < 0 ? 1 : 0);
    if (size.y >= size.z)
        return vec3(vec2(v.x, v.y < 0 ? -v.z : v.z) / size.y, v.y < 0 ? 3 : 2);
    return vec3(vec2(v.z < 0 ? -v.x : v.x, -v.y) / size.z, v.z < 0 ? 5 : 4);
}

// The texels are mixed here: a driver's own filter may have weights and results of 8 bits, which
// would leave more than a step of doubt.
vec3 looked_up(vec3 v) {
    if (v == vec3(0)) return vec3(0);
    vec3 place = place_on_cube(v);
    int size = textureSize(unit_vectors, 0).x;
    vec2 at = clamp(0.5 * float(size) * (place.xy + 1) - 0.5, 0, float(size - 1));
    ivec2 first = ivec2(at);
    ivec2 second = min(first + 1, size - 1);
    int face = int(place.z);
    vec3 upper = mix(texelFetch(unit_vectors, ivec3(first, face), 0).rgb,
                     texelFetch(unit_vectors, ivec3(second.x, first.y, face), 0).rgb,
                     at.x - float(first.x));
    vec3 lower = mix(texelFetch(unit_vectors, ivec3(first.x, second.y, face), 0).rgb,
                     texelFetch(unit_vectors, ivec3(second, face), 0).rgb, at.x - float(first.x));
    return 2 * mix(upper, lower, at.y - float(first.y)) - 1;
}

vec3 normalised(vec3 v) {
    if (normalisation == normalisation_cube_map) return looked_up(v);
    if (normalisation == normalisation_newton_raphson) return reciprocal_root(dot(v, v)) * v;
    return unit(v);
}
