// Bumps and decals as filters leave them. `bump_filter`, a value of BumpFilter, is defined before
// this text.
#include tangent_space.glsl
#include powers.glsl
#include mipmap.glsl

layout(binding = 7) uniform sampler2D slope_products; // as BumpPyramid::cross

const int filter_dimmed = 2;
const int filter_toksvig = 3;
const int filter_lean = 4;

// Of texture coordinates, between the pixels of a quad: to be taken before any of them is discarded.
struct Steps {
    vec2 across; // from a column to the next
    vec2 down;   // from a row to the next
};
Steps steps_of(vec2 at) {
    return Steps(dFdxFine(at), dFdyFine(at));
}

vec4 filtered_decal(Steps steps) {
    Footprint over = footprint(steps.across, steps.down, textureSize(decal_map, 0));
    vec4 decal = filtered(decal_map, decal_wrap_s, decal_wrap_t, surface.decal_at, over);
    return vec4(material_color * decal.rgb, gloss_in_alpha ? decal.a : 1);
}

// What a filter leaves of the bumps under a pixel.
struct Bumps {
    vec3 normal;       // of length 1
    float mean_length; // of the mean normal; 1 where the filter does not tell
    vec2 slope;        // the mean of slopes; lean alone
    vec3 spread;       // of slopes: variances along x and y, and their covariance; lean alone
};

Bumps smooth_surface() {
    return Bumps(vec3(0, 0, 1), 1, vec2(0), vec3(0));
}

Bumps filtered_bumps(Steps steps) {
    if (bump_form == 0) return smooth_surface();
    Footprint over = footprint(steps.across, steps.down, textureSize(bump_map, 0));
    vec4 mean = filtered(bump_map, bump_wrap_s, bump_wrap_t, surface.bump_at, over);
    Bumps bumps = smooth_surface();
    if (bump_filter == filter_lean) {
        float product =
            filtered(slope_products, bump_wrap_s, bump_wrap_t, surface.bump_at, over).r;
        bumps.normal = unit(vec3(mean.xy, 1));
        bumps.slope = mean.xy;
        bumps.spread = vec3(mean.zw - mean.xy * mean.xy, product - mean.x * mean.y);
        return bumps;
    }
    float size = length(mean.xyz);
    if (size > 0) bumps.normal = mean.xyz / size;
    if (bump_filter == filter_dimmed) bumps.mean_length = mean.a;
    if (bump_filter == filter_toksvig) bumps.mean_length = min(size, 1);
    return bumps;
}

// (H . N')^s, with less and wider light the shorter the mean normal is.
float toksvig_highlight(float cosine, float mean_length, float exponent) {
    float kept = mean_length / (mean_length + exponent * (1 - mean_length));
    return (1 + kept * exponent) / (1 + exponent) * power_of(max(0, cosine), kept * exponent);
}

// The share of slopes that mirror the light into the eye, with H over the surface as a slope; the
// surface between the bumps has the variance 1 / s.
float lean_highlight(vec3 h, Bumps bumps, float exponent) {
    float own = 1 / exponent;
    vec2 variance = bumps.spread.xy + own;
    float covariance = bumps.spread.z;
    float determinant = variance.x * variance.y - covariance * covariance;
    if (!(h.z > 0) || !(determinant > 0)) return 0;
    vec2 off = h.xy - h.z * bumps.slope;
    float square = max(0, variance.y * off.x * off.x - 2 * covariance * off.x * off.y +
                          variance.x * off.y * off.y) / (determinant * h.z * h.z);
    return own * exp2_of(-0.5 * log2_of_e * square) / sqrt(determinant);
}

float filtered_highlight(vec3 h, Bumps bumps) {
    float cosine = dot(h, bumps.normal);
    float exponent = float(1 << highlight_squarings);
    if (bump_form == 0) return specular_power(max(0, cosine));
    if (bump_filter == filter_toksvig) return toksvig_highlight(cosine, bumps.mean_length, exponent);
    if (bump_filter == filter_lean) return lean_highlight(h, bumps, exponent);
    return specular_power(max(0, cosine));
}
