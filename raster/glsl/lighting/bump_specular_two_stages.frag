#version 450 core
// The specular term, in tangent space, by two combiner stages. The pass binds the half-angle vector
// alone, so that the highlight is dimmed by its self-shadowing, whatever the rule asks for.
#include tangent_space.glsl
#include two_stages.glsl

void main() {
    if (!is_seen()) discard;
    color = specular_pass(hardware_normal(), carried_half(), specular_color * arriving_light(),
                          decal().a);
}
