#version 450 core
// Lighting in the tangent space of the point, by bumps and decals that are filtered over the pixel.
#include filtered.glsl

void main() {
    Steps decal_steps = steps_of(surface.decal_at);
    Steps bump_steps = steps_of(surface.bump_at);
    if (!is_seen()) discard;
    vec3 l = carried_light();
    vec3 h = carried_half();
    Bumps bumps = filtered_bumps(bump_steps);
    float dimmed = bump_filter == filter_dimmed ? bumps.mean_length : 1;
    float diffuse = dimmed * diffuse_term(l.z, dot(l, bumps.normal));
    float specular = highlight_shadow(l.z, h.z) * filtered_highlight(h, bumps);
    vec4 decal = filtered_decal(decal_steps);
    color = arriving_light() * (diffuse * decal.rgb + specular * decal.a * specular_color);
}
