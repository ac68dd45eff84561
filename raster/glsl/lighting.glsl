// What lighting knows of surface, material and light. Of two triangles that tie in depth only the
// one that is seen is lit.
#include texels.glsl

layout(binding = 0) uniform usampler2D seen_triangle;
layout(binding = 1) uniform sampler2D decal_map; // white where the material has none
layout(binding = 2) uniform sampler2D bump_map;

layout(location = 6) uniform vec3 material_color;
layout(location = 7) uniform vec3 specular_color;
layout(location = 8) uniform bool gloss_in_alpha;
layout(location = 9) uniform int bump; // a value of Bump
layout(location = 10) uniform float bump_scale;
layout(location = 12) uniform int decal_wrap_s; // values of Wrap
layout(location = 13) uniform int decal_wrap_t;
layout(location = 14) uniform int bump_wrap_s;
layout(location = 15) uniform int bump_wrap_t;
layout(location = 16) uniform vec3 light_color; // of the ambient pass: the ambient light's
layout(location = 17) uniform vec3 cone_axis;
layout(location = 18) uniform float cone_cosine; // of the outer cone
layout(location = 19) uniform float cone_scale;  // 0: the light shines everywhere
layout(location = 20) uniform bool inverse_square;

const int bump_none = 0;
const int bump_height_field = 2;

in Surface {
    vec3 from_eye;
    vec3 to_light;
    vec3 normal;
    vec3 tangent;
    vec2 decal_at;
    vec2 bump_at;
    flat float hand;
    flat uint triangle;
} surface;

layout(location = 0) out vec3 color;

bool is_seen() {
    return texelFetch(seen_triangle, ivec2(gl_FragCoord.xy), 0).r == surface.triangle;
}

// Zero where the length is zero.
vec3 unit(vec3 v) {
    float square = dot(v, v);
    return square > 0 ? v / sqrt(square) : vec3(0);
}

vec4 decal() {
    ivec2 size = textureSize(decal_map, 0);
    vec4 decal = sampled(decal_map, taps_at(decal_wrap_s, size.x, surface.decal_at.x),
                         taps_at(decal_wrap_t, size.y, surface.decal_at.y));
    return vec4(material_color * decal.rgb, gloss_in_alpha ? decal.a : 1);
}

// Of a height field, in heights per texel: along a row, and down the rows.
vec2 slope() {
    ivec2 size = textureSize(bump_map, 0);
    return bump_scale * sampled_slope(bump_map, bump_wrap_s, bump_wrap_t,
                                      taps_at(bump_wrap_s, size.x, surface.bump_at.x),
                                      taps_at(bump_wrap_t, size.y, surface.bump_at.y));
}

// Of a normal map: the normal in its texture's axes, x along a row, y up the picture.
vec3 mapped_normal() {
    if (bump == bump_none) return vec3(0, 0, 1);
    ivec2 size = textureSize(bump_map, 0);
    vec3 normal = 2 * sampled(bump_map, taps_at(bump_wrap_s, size.x, surface.bump_at.x),
                              taps_at(bump_wrap_t, size.y, surface.bump_at.y)).rgb - 1;
    return vec3(bump_scale * normal.xy, normal.z);
}

// Tangent, bitangent and normal; of a surface without a bump map the normal alone.
mat3 frame() {
    vec3 normal = unit(surface.normal);
    vec3 tangent = unit(surface.tangent - normal * dot(normal, surface.tangent));
    return mat3(tangent, surface.hand * cross(normal, tangent), normal);
}

// -1 where the back is seen: normals are those of the side that is seen.
float seen_side() {
    return gl_FrontFacing ? 1 : -1;
}

float self_shadow(float cosine) {
    return clamp(8 * cosine, 0, 1);
}

float specular_power(float cosine) {
    float square = cosine * cosine;
    float fourth = square * square;
    return fourth * fourth;
}

// The light that arrives from a direction of unit length, without visibility.
vec3 light_from(vec3 to_light) {
    vec3 light = light_color;
    if (cone_scale > 0) {
        float within = clamp((-dot(to_light, cone_axis) - cone_cosine) * cone_scale, 0, 1);
        light *= within * within;
    }
    return inverse_square ? light / dot(surface.to_light, surface.to_light) : light;
}

// From the cosines of light (l) and half-angle vector (h) with the surface's and the small normal.
vec3 lit_color(vec3 light, float l_normal, float l_small, float h_normal, float h_small) {
    float diffuse = self_shadow(l_normal) * max(0, l_small);
    float specular = self_shadow(h_normal) * specular_power(max(0, h_small));
    vec4 decal = decal();
    return light * (diffuse * decal.rgb + specular * decal.a * specular_color);
}
