// A vector over its length; a zero vector stays zero.
vec3 unit(vec3 v) {
    float square = dot(v, v);
    return square > 0 ? v / sqrt(square) : vec3(0);
}
