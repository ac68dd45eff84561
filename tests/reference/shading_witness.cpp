#include "tests/reference/shading_witness.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace shadowproof::witness {

namespace {

using Vector = std::array<double, 3>;
using Numbers = std::array<double, 4>;

Vector vector(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}
Vector minus(const Vector& a, const Vector& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
/// a + s b
Vector plus(const Vector& a, double s, const Vector& b) {
    return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}
double dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length(const Vector& a) {
    return std::sqrt(dot(a, a));
}
Vector unit(const Vector& a) {
    const double l = length(a);
    return {a[0] / l, a[1] / l, a[2] / l};
}

int modulo(int value, int period) {
    return (value % period + period) % period;
}

int wrapped(Wrap wrap, int texel, int n) {
    if (wrap == Wrap::clamp_to_edge) return std::clamp(texel, 0, n - 1);
    const int in_period = modulo(texel, wrap == Wrap::repeat ? n : 2 * n);
    return in_period < n ? in_period : 2 * n - 1 - in_period;
}

/// Bilinear: each of four texels by its area.
template <class At>
Numbers filtered(const TextureImage& texture, double u, double v, const At& at) {
    const double x = u * texture.texels.width - 0.5;
    const double y = v * texture.texels.height - 0.5;
    const double left = std::floor(x);
    const double top = std::floor(y);
    Numbers sum{};
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
            const double weight =
                (i == 0 ? 1 - (x - left) : x - left) * (j == 0 ? 1 - (y - top) : y - top);
            const Numbers texel = at(static_cast<int>(left) + i, static_cast<int>(top) + j);
            for (std::size_t k = 0; k < 4; ++k) sum[k] += weight * texel[k];
        }
    return sum;
}

Numbers texel_at(const TextureImage& texture, int x, int y) {
    const glm::vec4 texel = texture.texels.at(wrapped(texture.wrap_s, x, texture.texels.width),
                                              wrapped(texture.wrap_t, y, texture.texels.height));
    return {texel.r, texel.g, texel.b, texel.a};
}

double from_srgb(double c) {
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}
double to_srgb(double c) {
    return c <= 0.0031308 ? c * 12.92 : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
}

template <double (*convert)(double)>
Numbers converted_colors(Numbers texel) {
    for (std::size_t k = 0; k < 3; ++k) texel[k] = convert(texel[k]);
    return texel;
}

/// The normal in tangent space, from the map or the height field.
Vector small_normal(const TextureImage& map, const Material& material, double u, double v,
                    Fault fault) {
    Vector normal{};
    if (material.bump == Bump::height_field) {
        const Numbers slopes = filtered(map, u, v, [&](int x, int y) {
            // A neighbour off a clamped or mirrored border is the border texel.
            x = wrapped(map.wrap_s, x, map.texels.width);
            y = wrapped(map.wrap_t, y, map.texels.height);
            return Numbers{(texel_at(map, x + 1, y)[0] - texel_at(map, x - 1, y)[0]) / 2,
                           (texel_at(map, x, y + 1)[0] - texel_at(map, x, y - 1)[0]) / 2, 0, 0};
        });
        normal = {-material.bump_scale * slopes[0], material.bump_scale * slopes[1], 1};
    } else {
        const Numbers color = filtered(map, u, v, [&](int x, int y) {
            const Numbers texel = texel_at(map, x, y);
            return fault == Fault::srgb_normal_map ? converted_colors<from_srgb>(texel) : texel;
        });
        normal = {(2 * color[0] - 1) * material.bump_scale,
                  (2 * color[1] - 1) * material.bump_scale, 2 * color[2] - 1};
    }
    if (fault == Fault::inverted_green) normal[1] = -normal[1];
    return fault == Fault::no_renormalise && material.bump == Bump::normal_map ? normal
                                                                               : unit(normal);
}

/// The normal of a relief over texels as large as the triangle makes them. Two vectors in its
/// tangent plane: each side of a texel, lifted along the normal by what the height grows on it; a
/// normal is at right angles to both. A side's part along the interpolated normal is no height.
Vector off_stretched_texels(const Scene& scene, std::uint32_t triangle, const Vector& n,
                            const std::array<double, 2>& slope) {
    const Material& material = scene.materials[scene.meshes[mesh_of(scene, triangle)].material];
    const Image<glm::vec4>& texels = scene.textures[material.bump_map].texels;
    std::array<Vector, 3> p{};
    std::array<double, 3> s{};
    std::array<double, 3> t{};
    for (std::size_t k = 0; k < 3; ++k) {
        p[k] = vector(corner(scene, triangle, static_cast<int>(k)));
        const glm::vec2 at = scene.surfaces[3 * std::size_t{triangle} + k].bump_at;
        s[k] = double{at.x} * texels.width;
        t[k] = double{at.y} * texels.height;
    }
    const Vector e = minus(p[1], p[0]);
    const Vector f = minus(p[2], p[0]);
    // One texel along s alone: a e + b f with a ds1 + b ds2 = 1 and a dt1 + b dt2 = 0.
    const double det = (s[1] - s[0]) * (t[2] - t[0]) - (s[2] - s[0]) * (t[1] - t[0]);
    if (det == 0) return n;
    Vector along = plus({0, 0, 0}, (t[2] - t[0]) / det, e);
    along = plus(along, -(t[1] - t[0]) / det, f);
    Vector down = plus({0, 0, 0}, -(s[2] - s[0]) / det, e);
    down = plus(down, (s[1] - s[0]) / det, f);
    along = plus(along, slope[0] - dot(along, n), n);
    down = plus(down, slope[1] - dot(down, n), n);
    const Vector across = unit(cross(along, down));
    return dot(across, n) < 0 ? Vector{-across[0], -across[1], -across[2]} : across;
}

double clamp01(double x) {
    return std::min(1.0, std::max(0.0, x));
}

/// What a direction shows of six faces: sc, tc and ma by OpenGL 4.5, table 8.19.
Vector surroundings(const CubeFaces<glm::vec3>& faces, const Vector& r) {
    const double x = std::abs(r[0]);
    const double y = std::abs(r[1]);
    const double z = std::abs(r[2]);
    std::size_t face = 0;
    double sc = 0, tc = 0, ma = 0;
    if (x >= y && x >= z) {
        face = r[0] >= 0 ? 0 : 1;
        sc = r[0] >= 0 ? -r[2] : r[2];
        tc = -r[1];
        ma = x;
    } else if (y >= z) {
        face = r[1] >= 0 ? 2 : 3;
        sc = r[0];
        tc = r[1] >= 0 ? r[2] : -r[2];
        ma = y;
    } else {
        face = r[2] >= 0 ? 4 : 5;
        sc = r[2] >= 0 ? r[0] : -r[0];
        tc = -r[1];
        ma = z;
    }
    TextureImage picture;
    picture.wrap_s = picture.wrap_t = Wrap::clamp_to_edge;
    picture.texels = converted<glm::vec4>(
        faces[face], [](const glm::vec3& texel) { return glm::vec4(texel, 1); });
    const Numbers color = filtered(picture, (sc / ma + 1) / 2, (tc / ma + 1) / 2,
                                   [&](int i, int j) { return texel_at(picture, i, j); });
    return {color[0], color[1], color[2]};
}

} // namespace

std::string name_of(Fault fault) {
    constexpr std::array names{
        "none",           "flipped_hand",   "exponent_9", "no_self_shadow", "srgb_normal_map",
        "inverted_green", "no_renormalise", "no_gloss",   "linear_decal",   "turned_reflection",
        "flat_reflection"};
    return names[static_cast<std::size_t>(fault)];
}

glm::dvec3 color_at(const Scene& scene, const glm::dvec3& direction, std::uint32_t triangle,
                    bool lit, Fault fault) {
    // Where the ray meets the triangle, and the shares of its area opposite each corner.
    const Vector eye = vector(scene.camera.eye);
    const Vector d = vector(direction);
    std::array<Vector, 3> p{};
    for (int k = 0; k < 3; ++k) p[static_cast<std::size_t>(k)] = vector(corner(scene, triangle, k));
    const Vector across = cross(minus(p[1], p[0]), minus(p[2], p[0]));
    const double t = dot(minus(p[0], eye), across) / dot(d, across);
    const Vector point = plus(eye, t, d);
    Vector share{};
    for (std::size_t k = 0; k < 3; ++k)
        share[k] = dot(cross(minus(p[(k + 1) % 3], point), minus(p[(k + 2) % 3], point)), across) /
                   dot(across, across);

    Vector n{};
    Vector tangent{};
    double decal_u = 0, decal_v = 0, bump_u = 0, bump_v = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Surface& surface = scene.surfaces[3 * triangle + k];
        n = plus(n, share[k], vector(surface.normal));
        tangent = plus(tangent, share[k], vector(glm::vec3(surface.tangent)));
        decal_u += share[k] * surface.decal_at.x;
        decal_v += share[k] * surface.decal_at.y;
        bump_u += share[k] * surface.bump_at.x;
        bump_v += share[k] * surface.bump_at.y;
    }
    if (fault != Fault::no_renormalise) n = unit(n);
    const Material& material = scene.materials[scene.meshes[mesh_of(scene, triangle)].material];
    Vector bumped = n;
    if (material.bump != Bump::none) {
        const Vector m =
            small_normal(scene.textures[material.bump_map], material, bump_u, bump_v, fault);
        const Vector along = unit(plus(tangent, -dot(tangent, n), n));
        const double hand = scene.surfaces[3 * triangle].tangent.w;
        const Vector up = cross(n, along);
        const double y = m[1] * (fault == Fault::flipped_hand ? -hand : hand);
        bumped = {0, 0, 0};
        bumped = plus(bumped, m[0], along);
        bumped = plus(bumped, y, up);
        bumped = plus(bumped, m[2], n);
        if (material.height_in_space)
            bumped = off_stretched_texels(scene, triangle, n, {-m[0] / m[2], m[1] / m[2]});
    }
    if (dot(d, across) > 0) { // seen from behind
        n = {-n[0], -n[1], -n[2]};
        bumped = {-bumped[0], -bumped[1], -bumped[2]};
    }

    const Light& source = chosen_light(scene);
    const bool sun = source.kind == Light::Kind::directional;
    const Vector away =
        sun ? plus({0, 0, 0}, -1, vector(source.direction)) : minus(vector(source.position), point);
    const Vector l = unit(away);
    double strength = 1;
    if (source.kind == Light::Kind::spot) {
        const double outer = std::cos(source.outer_cone);
        const double cone = clamp01((-dot(l, vector(source.direction)) - outer) /
                                    std::max(0.001, std::cos(source.inner_cone) - outer));
        strength *= cone * cone;
    }
    if (scene.inverse_square)
        strength *= source.intensity / (sun ? 1.0 : length(away) * length(away));
    const Vector halfway = minus(l, unit(d));
    const Vector h = length(halfway) > 0 ? unit(halfway) : Vector{0, 0, 0};

    const bool self_shadow = fault != Fault::no_self_shadow;
    const double diffuse =
        (self_shadow ? clamp01(8 * dot(l, n)) : 1) * std::max(0.0, dot(l, bumped));
    const HighlightShadow dims = scene.highlight.shadow;
    double specular = std::pow(std::max(0.0, dot(h, bumped)),
                               fault == Fault::exponent_9 ? 9 : scene.highlight.exponent());
    if (self_shadow && (dims == HighlightShadow::light || dims == HighlightShadow::both))
        specular *= clamp01(8 * dot(l, n));
    if (self_shadow && (dims == HighlightShadow::half_angle || dims == HighlightShadow::both))
        specular *= clamp01(8 * dot(h, n));

    Numbers decal{1, 1, 1, 1};
    if (material.decal != no_texture) {
        const TextureImage& texture = scene.textures[material.decal];
        decal = filtered(texture, decal_u, decal_v, [&](int x, int y) {
            const Numbers texel = texel_at(texture, x, y);
            return fault == Fault::linear_decal ? converted_colors<to_srgb>(texel) : texel;
        });
    }
    const double gloss = material.gloss_in_alpha && fault != Fault::no_gloss ? decal[3] : 1;
    Vector reflected{};
    if (scene.environment) {
        const Vector mirror = fault == Fault::flat_reflection ? n : bumped;
        const Vector to_eye = unit(plus({0, 0, 0}, -1, d));
        Vector r = plus({0, 0, 0}, 2 * dot(mirror, to_eye), mirror);
        r = minus(r, to_eye);
        if (fault == Fault::turned_reflection) r = {-r[0], -r[1], -r[2]};
        reflected = surroundings(*scene.environment, r);
    }
    glm::dvec3 color(0);
    for (int k = 0; k < 3; ++k) {
        const double light = lit ? source.color[k] * strength : 0;
        const double surface = material.color[k] * decal[static_cast<std::size_t>(k)];
        color[k] = (light * diffuse + scene.ambient[k]) * surface +
                   light * specular * gloss * material.specular[k] +
                   material.reflectance[k] * gloss * reflected[static_cast<std::size_t>(k)];
    }
    return color;
}

} // namespace shadowproof::witness
