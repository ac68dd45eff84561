// Whether a triangle's front faces the light: the determinant of scenes/orientation.h, in double.
// Where rounding decides its sign, it may differ from the exact one, but it is the same wherever it
// is computed.

layout(location = 11) uniform float light_w; // 0: the light is a direction

bool is_before(vec3 a, vec3 b) {
    return a.x != b.x ? a.x < b.x : (a.y != b.y ? a.y < b.y : a.z < b.z);
}

bool faces(vec3 a, vec3 b, vec3 c, dvec3 light) {
    // From the first of its corners on, so that neighbours that have it in another order agree.
    for (int turn = 0; turn < 2 && (is_before(b, a) || is_before(c, a)); ++turn) {
        vec3 first = a;
        a = b;
        b = c;
        c = first;
    }
    precise dvec3 ab = dvec3(b) - dvec3(a);
    precise dvec3 ac = dvec3(c) - dvec3(a);
    precise dvec3 al = light - double(light_w) * dvec3(a);
    precise double x = ab.y * ac.z - ac.y * ab.z;
    precise double y = ab.z * ac.x - ac.z * ab.x;
    precise double z = ab.x * ac.y - ac.x * ab.y;
    precise double sum = (x * al.x + y * al.y) + z * al.z;
    return sum > 0;
}
