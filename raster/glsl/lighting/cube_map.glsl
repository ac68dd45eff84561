// Cube maps with one layer per face, as in cube_map.h.

// The face that a vector points to, and the place on it: along its rows and down them, in [-1, 1]
// (OpenGL 4.5, table 8.19). Among components of equal size x goes before y before z.
vec3 place_on_cube(vec3 v) {
    vec3 size = abs(v);
    if (size.x >= size.y && size.x >= size.z)
        return vec3(vec2(v.x < 0 ? v.z : -v.z, -v.y) / size.x, v.x < 0 ? 1 : 0);
    if (size.y >= size.z)
        return vec3(vec2(v.x, v.y < 0 ? -v.z : v.z) / size.y, v.y < 0 ? 3 : 2);
    return vec3(vec2(v.z < 0 ? -v.x : v.x, -v.y) / size.z, v.z < 0 ? 5 : 4);
}

// The texels are interpolated here: a driver's own filter may have weights and results of 8 bits,
// which would add an error of more than a step.
vec3 sampled_on_cube(sampler2DArray faces, vec3 v) {
    vec3 place = place_on_cube(v);
    int size = textureSize(faces, 0).x;
    vec2 at = clamp(0.5 * float(size) * (place.xy + 1) - 0.5, 0, float(size - 1));
    ivec2 first = ivec2(at);
    ivec2 second = min(first + 1, size - 1);
    int face = int(place.z);
    vec3 upper = mix(texelFetch(faces, ivec3(first, face), 0).rgb,
                     texelFetch(faces, ivec3(second.x, first.y, face), 0).rgb,
                     at.x - float(first.x));
    vec3 lower = mix(texelFetch(faces, ivec3(first.x, second.y, face), 0).rgb,
                     texelFetch(faces, ivec3(second, face), 0).rgb, at.x - float(first.x));
    return mix(upper, lower, at.y - float(first.y));
}
