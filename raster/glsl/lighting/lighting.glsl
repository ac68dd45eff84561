// The inputs of lighting: surface, material and light. Of two triangles with equal depth only the
// visible one is lit. `forms_in_use` is defined before this text: bit k is set where some
// material's bump_form is k.
#include texels.glsl
#include normalise.glsl

layout(binding = 0) uniform usampler2D seen_triangle;
layout(binding = 1) uniform sampler2D decal_map; // white where the material has none
layout(binding = 2) uniform sampler2D bump_map; // as in bump_forms.h
layout(binding = 4) uniform sampler2D normal_table; // of number 256 y + x

layout(location = 6) uniform vec3 material_color;
layout(location = 7) uniform vec3 specular_color;
layout(location = 8) uniform bool gloss_in_alpha;
layout(location = 9) uniform int bump_form; // a value of BumpForm; 0 without a map
layout(location = 10) uniform float bump_scale;
layout(location = 12) uniform int decal_wrap_s; // values of Wrap
layout(location = 13) uniform int decal_wrap_t;
layout(location = 14) uniform int bump_wrap_s;
layout(location = 15) uniform int bump_wrap_t;
layout(location = 16) uniform vec3 light_color;
layout(location = 17) uniform vec3 cone_axis;
layout(location = 18) uniform float cone_cosine; // of the outer cone
layout(location = 19) uniform float cone_scale;  // 0: the light shines everywhere
layout(location = 20) uniform bool inverse_square;
layout(location = 22) uniform float slope_range;
layout(location = 30) uniform float texel_side; // as in bump_forms.h; 0 where heights are in texels
layout(location = 23) uniform vec3 ambient_color;
layout(location = 24) uniform vec3 reflectance;
layout(location = 25) uniform bool highlight_by_light; // whose self-shadowing dims the highlight
layout(location = 26) uniform bool highlight_by_half_angle;
layout(location = 27) uniform int highlight_squarings;

const int bump_height_field = 1;
const int bump_normal_map = 2;
const int bump_derivatives = 3;
const int bump_indexed = 4;

in Surface {
    vec3 from_eye;
    vec3 to_light;
    vec3 normal;
    vec3 tangent;
    vec3 vertex_light;
    vec3 vertex_half;
    vec2 decal_at;
    vec2 bump_at;
    flat vec3 texel_along;
    flat vec3 texel_down;
    flat float hand;
    flat uint triangle;
} surface;

layout(location = 0) out vec3 color;

bool is_seen() {
    return texelFetch(seen_triangle, ivec2(gl_FragCoord.xy), 0).r == surface.triangle;
}

vec4 decal() {
    ivec2 size = textureSize(decal_map, 0);
    vec4 decal = sampled(decal_map, taps_at(decal_wrap_s, size.x, surface.decal_at.x),
                         taps_at(decal_wrap_t, size.y, surface.decal_at.y));
    return vec4(material_color * decal.rgb, gloss_in_alpha ? decal.a : 1);
}

Taps bump_taps_s() {
    return taps_at(bump_wrap_s, textureSize(bump_map, 0).x, surface.bump_at.x);
}
Taps bump_taps_t() {
    return taps_at(bump_wrap_t, textureSize(bump_map, 0).y, surface.bump_at.y);
}

bool holds(int form) {
    return (forms_in_use & 1 << form) != 0 && bump_form == form;
}

// Whether the map holds slopes, or heights of which slopes are made; else it holds normals.
bool has_slopes() {
    return holds(bump_height_field) || holds(bump_derivatives);
}

// The slopes along a row and down the rows, in heights per texel.
vec2 slope() {
    Taps s = bump_taps_s();
    Taps t = bump_taps_t();
    if (holds(bump_derivatives))
        return slope_range * (2 * sampled(bump_map, s, t).rg - 1);
    if (holds(bump_height_field))
        return bump_scale * sampled_slope(bump_map, bump_wrap_s, bump_wrap_t, s, t);
    return vec2(0);
}

vec3 indexed_normal(int s, int t) {
    int number = int(texelFetch(bump_map, ivec2(s, t), 0).r);
    return texelFetch(normal_table, ivec2(number % 256, number / 256), 0).rgb;
}

// Numbers cannot be interpolated, but the normals that they index can.
vec3 mixed_indexed_normal(Taps s, Taps t) {
    vec3 upper = mix(indexed_normal(s.first, t.first), indexed_normal(s.second, t.first),
                     s.fraction);
    vec3 lower = mix(indexed_normal(s.first, t.second), indexed_normal(s.second, t.second),
                     s.fraction);
    return mix(upper, lower, t.fraction);
}

// The normal of a map that holds normals, in its texture's axes, x along a row, y up the picture;
// interpolated and not normalised.
vec3 mapped_normal() {
    Taps s = bump_taps_s();
    Taps t = bump_taps_t();
    if (holds(bump_indexed)) return mixed_indexed_normal(s, t);
    if (!holds(bump_normal_map)) return vec3(0, 0, 1);
    vec3 normal = 2 * sampled(bump_map, s, t).rgb - 1;
    return vec3(bump_scale * normal.xy, normal.z);
}

// Tangent, bitangent and normal; without a bump map the normal alone.
mat3 frame() {
    vec3 normal = unit(surface.normal);
    vec3 tangent = unit(surface.tangent - normal * dot(normal, surface.tangent));
    return mat3(tangent, surface.hand * cross(normal, tangent), normal);
}

// -1 where the back is seen: normals are taken on the visible side.
float seen_side() {
    return gl_FrontFacing ? 1 : -1;
}

float self_shadow(float cosine) {
    return clamp(8 * cosine, 0, 1);
}

// The power whose exponent is 2 to the number of squarings.
float specular_power(float cosine) {
    float power = cosine;
    for (int i = 0; i < highlight_squarings; ++i) power *= power;
    return power;
}

// L, V and H, as exactly normalised as normalised() does it.
vec3 light_direction() {
    return normalised(surface.to_light);
}
vec3 eye_direction() {
    return normalised(-surface.from_eye);
}
vec3 half_angle() {
    return normalised(light_direction() + eye_direction());
}

// The light that arrives, without visibility. Its direction is exact under all settings.
vec3 arriving_light() {
    vec3 light = light_color;
    if (cone_scale > 0) {
        float cosine = -dot(unit(surface.to_light), cone_axis);
        float within = clamp((cosine - cone_cosine) * cone_scale, 0, 1);
        light *= within * within;
    }
    return inverse_square ? light / dot(surface.to_light, surface.to_light) : light;
}

// From the cosines of light (l) or half-angle vector (h) with the surface's and the perturbed
// normal.
float diffuse_term(float l_normal, float l_perturbed) {
    return self_shadow(l_normal) * max(0, l_perturbed);
}
float highlight_shadow(float l_normal, float h_normal) {
    return (highlight_by_light ? self_shadow(l_normal) : 1) *
           (highlight_by_half_angle ? self_shadow(h_normal) : 1);
}

vec3 lit_color(vec3 light, float l_normal, float l_perturbed, float h_normal, float h_perturbed) {
    float diffuse = diffuse_term(l_normal, l_perturbed);
    float specular = highlight_shadow(l_normal, h_normal) * specular_power(max(0, h_perturbed));
    vec4 decal = decal();
    return light * (diffuse * decal.rgb + specular * decal.a * specular_color);
}
