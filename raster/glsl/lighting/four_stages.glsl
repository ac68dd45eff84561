// Register combiners as set by one pass of Kilgard's "bump mapping in one pass on GeForce3": four
// general stages and the final one.
#include registers.glsl

struct Registers {
    vec4 tex0; // rgb: the perturbed normal; then the factor of the highlight
    vec3 tex1; // L
    vec3 tex2; // H
    vec4 tex3; // the decal and, in alpha, gloss
    vec3 primary_color;
    vec3 secondary_color;
    vec4 spare0;
    vec4 spare1;
};

// N'.L, N'.H, and the factor of L's self-shadowing.
void stage0(inout Registers r) {
    Registers from = r;
    r.spare0.rgb = vec3(q(dot(from.tex0.rgb, from.tex1)));
    r.spare1.rgb = vec3(q(dot(from.tex0.rgb, from.tex2)));
    r.spare0.a = q(8 * from.tex1.z);
}

void stage1(inout Registers r) {
    Registers from = r;
    r.spare0.rgb = q(vec3(max0(from.spare0.b) * max0(from.spare0.a)));
    r.primary_color = q(from.tex3.rgb * from.primary_color);
    r.spare0.a = q(max0(from.spare0.a) * from.tex3.a);
    r.spare1.a = q(max0(from.spare1.b) * max0(from.spare1.b));
}

void stage2(inout Registers r, vec3 ambient) {
    Registers from = r;
    r.secondary_color = q(ambient * from.tex3.rgb);
    r.tex0.rgb = q(from.secondary_color * max0(from.spare0.a));
    r.spare0.a = q(from.tex0.a * from.spare0.b);
    r.spare1.a = q(from.spare1.a * from.spare1.a);
}

void stage3(inout Registers r) {
    Registers from = r;
    r.spare0.rgb = q(from.spare0.a * from.primary_color);
    r.spare1.rgb = q(vec3(from.spare1.a * from.spare1.a));
    r.spare1.a = q(8 * from.tex2.z);
}

// A E F + D: E F is a product of its own, D the sum of spare0 and the secondary colour.
vec3 final_stage(Registers r) {
    vec3 e_f = q(max0(r.spare1.a) * r.spare1.rgb);
    vec3 d = clamp(r.spare0.rgb + r.secondary_color, 0, 1);
    return clamp(q(r.tex0.rgb * e_f + d), 0, 1);
}

// The colour from vectors in tangent space. tex0.a, which dims rough texels of smaller mipmap
// levels, is 1 at level 0. The highlight is multiplied by the self-shadowing of L and of H, as on the
// slides.
vec3 combined(vec3 normal, vec3 l, vec3 h, vec4 decal, vec3 light, vec3 specular, vec3 ambient) {
    Registers r;
    r.tex0 = vec4(expanded_bytes(normal), 1);
    r.tex1 = expanded_bytes(l);
    r.tex2 = expanded_bytes(h);
    r.tex3 = in_bytes(decal);
    r.primary_color = q(light);
    r.secondary_color = q(specular);
    r.spare0 = vec4(0);
    r.spare1 = vec4(0);
    stage0(r);
    stage1(r);
    stage2(r, q(ambient));
    stage3(r);
    return final_stage(r);
}
