// Register combiners as the passes of a GeForce 256 and 2 set them: two general stages and the final
// one, with two textures, which are the normal map and the normalisation cube map.
#include registers.glsl

// Stage 0 of both passes: N' . v and, in alpha, v's self-shadowing.
vec4 stage0(vec3 normal, vec3 v) {
    vec3 tex0 = expanded_bytes(normal);
    vec3 tex1 = expanded_bytes(v);
    return vec4(vec3(q(dot(tex0, tex1))), q(8 * tex1.z));
}

// The pass of diffuse light. Final combiner: A B + D, D being the ambient light.
vec3 diffuse_pass(vec3 normal, vec3 l, vec3 light, vec3 ambient) {
    vec4 spare0 = stage0(normal, l);
    spare0.rgb = q(vec3(max0(spare0.b) * max0(spare0.a)));
    return clamp(q(spare0.rgb * q(light) + q(ambient)), 0, 1);
}

// The pass of the highlight. Stage 1 squares N' . H and dims the highlight's colour. The final
// combiner's E F squares again, its A B once more: then no product is left that would take the
// colour. The slides do not say how two stages hold the rule's eighth power, its self-shadowing and
// a colour; the pass gets the one product that it lacks, rounded as all the others are. Gloss comes
// from the decal, of which the pass before could leave the alpha in the frame buffer.
vec3 specular_pass(vec3 normal, vec3 h, vec3 specular, float gloss) {
    vec4 spare0 = stage0(normal, h);
    vec3 spare1 = q(q(specular) * max0(spare0.a));
    float squared = q(max0(spare0.b) * max0(spare0.b));
    float e_f = q(squared * squared);
    float a_b = q(e_f * e_f);
    return clamp(q(spare1 * a_b), 0, 1) * in_bytes(vec4(gloss)).x;
}
