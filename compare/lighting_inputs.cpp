#include "compare/lighting_inputs.h"

#include "compare/lighting_tables.h"
#include "scenes/spot_cone.h"

#include <bit>
#include <cassert>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace shadowproof {

namespace {

constexpr double v = 0x1p-24; ///< rounding unit of float

template <class T>
using ThreeOf = std::array<T, 3>;

template <class Of>
double largest_length(const Of& of) {
    return std::max({glm::length(of(0)), glm::length(of(1)), glm::length(of(2))});
}

const Material& material_of(const Scene& scene, std::uint32_t triangle) {
    return scene.materials[scene.meshes[mesh_of(scene, triangle)].material];
}

const Surface& surface_of(const Scene& scene, std::uint32_t triangle, int k) {
    return scene.surfaces[std::size_t{3} * triangle + static_cast<std::size_t>(k)];
}

/// What a corner's `of` comes to at the point.
template <class Of>
auto interpolated(const glm::dvec3& weights, const Of& of) {
    return weights.x * of(0) + weights.y * of(1) + weights.z * of(2);
}

glm::dvec3 unit_or_zero(const glm::dvec3& vector) {
    const double length = glm::length(vector);
    return length > 0 ? vector / length : glm::dvec3(0);
}

/// Lomont's reciprocal square root (2003): a guess by halving the exponent, then one step of Newton
/// and Raphson; its relative error is at most 0.0017523.
double newton_raphson_root(double square) {
    const auto x = static_cast<float>(square);
    const auto bits = std::bit_cast<std::uint32_t>(x);
    const double guess = std::bit_cast<float>(0x5f3759dfU - (bits >> 1U));
    return guess * (1.5 - 0.5 * square * guess * guess);
}

/// A vector of unit length, as the technique makes it in its own axes, of one known within
/// `radius`.
// Roundings: of the square (3 v), its root (v), the quotient (v): 4 v of a length of 1. A lookup
// turns with the vector, and jumps where it comes to look at another face: it is taken at the ends
// of the radius, and what that makes of it counts twice, for what lies between.
Intervals normalised(const LightingTables& tables, const glm::dvec3& vector, double radius) {
    const double length = glm::length(vector);
    if (!(length > 0)) return around(glm::dvec3(0), 1);
    const double turn = radius / length;
    switch (tables.model.normalisation) {
    case Normalisation::exact:
        break;
    case Normalisation::newton_raphson:
        // The step flattens what the guess makes of the length: a share of it, no more, is left.
        return around(newton_raphson_root(length * length) * vector, 2 * turn + 8 * v);
    case Normalisation::cube_map: {
        Intervals all = around(looked_up(tables.cube, vector));
        for (int axis = 0; axis < 3; ++axis)
            for (const double sign : {-1.0, 1.0}) {
                glm::dvec3 moved = vector;
                moved[axis] += sign * std::max(radius, 4 * v * length);
                all = hull(all, around(looked_up(tables.cube, moved)));
            }
        for (Interval& component : all)
            component = widened(component, component.high - component.low + cube_lookup_error);
        return all;
    }
    }
    return around(vector / length, turn + 4 * v);
}

/// The half width of the widest.
double radius_of(const Intervals& a) {
    double widest = 0;
    for (const Interval& component : a) widest = std::max(widest, component.high - component.low);
    return 0.5 * widest;
}

Intervals sum(const Intervals& a, const Intervals& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

/// T, B and N of the seen side, and how far each is off.
struct TangentFrame {
    glm::dvec3 tangent, bitangent, normal;
    double tangent_off = 0;
    double normal_off = 0;
};

TangentFrame frame_at(const InputPoint& point) {
    const Shading& shading = point.shading;
    TangentFrame frame;
    frame.normal = shading.normal;
    frame.tangent = shading.side * shading.tangent;
    frame.bitangent =
        shading.side * shading.hand * glm::cross(shading.side * shading.normal, shading.tangent);
    return frame;
}

/// Corners of unit length that point apart leave little between them, of which an error is a larger
/// share. Roundings: 8 v for making it of unit length and, of T, at right angles to N.
TangentFrame frame_at(const Scene& scene, const InputPoint& point, double share) {
    TangentFrame frame = frame_at(point);
    const glm::dvec3& weights = point.shading.weights;
    const auto normal = interpolated(
        weights, [&](int k) { return glm::dvec3(surface_of(scene, point.triangle, k).normal); });
    const auto tangent = interpolated(weights, [&](int k) {
        return glm::dvec3(glm::vec3(surface_of(scene, point.triangle, k).tangent));
    });
    frame.normal_off = share / glm::length(normal) + 8 * v;
    const glm::dvec3 n = glm::normalize(normal);
    const double across = glm::length(tangent - n * glm::dot(n, tangent));
    if (across > 0) frame.tangent_off = (share + 2 * frame.normal_off + 8 * v) / across + 8 * v;
    return frame;
}

TangentFrame turned(const glm::dmat3& axes, TangentFrame frame) {
    frame.tangent = axes * frame.tangent;
    frame.bitangent = axes * frame.bitangent;
    frame.normal = axes * frame.normal;
    return frame;
}

Intervals into(const TangentFrame& frame, const Intervals& vector) {
    const Intervals tangent = around(frame.tangent, frame.tangent_off);
    const Intervals bitangent = around(frame.bitangent, frame.tangent_off + frame.normal_off);
    const Intervals normal = around(frame.normal, frame.normal_off);
    Intervals carried{dot(vector, tangent), dot(vector, bitangent), dot(vector, normal)};
    if (frame.normal_off > 0)
        for (Interval& component : carried) component = widened(component, 4 * v);
    return carried;
}

/// N' in world space, where m is known as well as `bump` says.
Intervals out_of(const TangentFrame& frame, const Intervals& bump) {
    const Intervals tangent = around(frame.tangent, frame.tangent_off);
    const Intervals bitangent = around(frame.bitangent, frame.tangent_off + frame.normal_off);
    const Intervals normal = around(frame.normal, frame.normal_off);
    Intervals carried;
    for (std::size_t k = 0; k < 3; ++k)
        carried[k] =
            widened(bump[0] * tangent[k] + bump[1] * bitangent[k] + bump[2] * normal[k], 4 * v);
    return carried;
}

/// What the environment shows along the eye's direction mirrored at the small normal.
// Roundings of R: of N' . V (3 v), twice that times N' (2 v), the difference (3 v: R is at most 3
// long before they cancel). Of the place on the face, as if R moved: the quotient (v), that plus 1
// and what is left of it among `size` texels (6 v). Of the mixture of texels, which are at most 1,
// along rows and between them: 8 v.
// The lookup turns with R, and jumps where R comes to look at another face: it is taken at the
// corners of all that R may be, which reach furthest over each edge, and what that makes of it
// counts twice, for what lies between.
Intervals environment_at(const CubeFaces<glm::vec3>& faces, const Intervals& normal,
                         const Intervals& to_eye) {
    const Interval cosine = dot(normal, to_eye);
    Intervals mirrored;
    for (std::size_t k = 0; k < 3; ++k)
        mirrored[k] =
            widened(2 * cosine * normal[k] + -1 * to_eye[k], 3 * v + 2 * v + 3 * v + 7 * v);
    Intervals all = around(sample<glm::dvec3>(faces, middle(mirrored)));
    for (const double x : {mirrored[0].low, mirrored[0].high})
        for (const double y : {mirrored[1].low, mirrored[1].high})
            for (const double z : {mirrored[2].low, mirrored[2].high})
                all = hull(all, around(sample<glm::dvec3>(faces, {x, y, z})));
    for (Interval& channel : all) channel = widened(channel, channel.high - channel.low + 8 * v);
    return all;
}

/// What a texture's texels come to between them, as `of` decodes them.
template <class T, class Of>
T mixed(const TextureImage& map, const Image<glm::vec4>& texels, const glm::dvec2& at,
        const Of& of) {
    const Taps s = taps_at(map.wrap_s, texels.width, at.x);
    const Taps t = taps_at(map.wrap_t, texels.height, at.y);
    const auto along = [&](int row) {
        const T a = of(glm::dvec4(texels.at(s.first, row)));
        return a + s.fraction * (of(glm::dvec4(texels.at(s.second, row))) - a);
    };
    const T upper = along(t.first);
    return upper + t.fraction * (along(t.second) - upper);
}

/// m of the technique: of unit length where slopes were made into it, and where lighting is in
/// floats throughout; else as mixed.
glm::dvec3 bump_at(const LightingTables& tables, const Material& material, const glm::dvec2& at) {
    if (material.bump == Bump::none) return {0, 0, 1};
    const auto index = static_cast<std::size_t>(&material - tables.scene->materials.data());
    const BumpTexels& bumps = *tables.bumps[index];
    const TextureImage& map = tables.scene->textures[material.bump_map];
    glm::dvec3 m(0, 0, 1);
    bool make_unit = tables.model.arithmetic == ColorModel::Arithmetic::floating;
    const auto from_slopes = [&](const glm::dvec2& slope) {
        m = {-slope.x, slope.y, 1};
        make_unit = true;
    };
    switch (bumps.form) {
    case BumpForm::height_field: {
        const Image<glm::dvec2>& slopes = tables.slopes[index];
        from_slopes(sample<glm::dvec2>(slopes, taps_at(map.wrap_s, slopes.width, at.x),
                                       taps_at(map.wrap_t, slopes.height, at.y)));
        break;
    }
    case BumpForm::derivatives:
        from_slopes(mixed<glm::dvec2>(map, bumps.texels, at, [&](const glm::dvec4& texel) {
            return bumps.slope_range * (2.0 * glm::dvec2(texel) - 1.0);
        }));
        break;
    case BumpForm::indexed:
        m = mixed<glm::dvec3>(map, bumps.texels, at, [](const glm::dvec4& texel) {
            return expected_normal(static_cast<std::uint16_t>(texel.r));
        });
        break;
    case BumpForm::as_given:
    case BumpForm::normal_map:
        m = mixed<glm::dvec3>(map, bumps.texels, at, [](const glm::dvec4& texel) {
            return 2.0 * glm::dvec3(texel) - 1.0;
        });
        m = {bumps.scale * m.x, bumps.scale * m.y, m.z};
        break;
    }
    if (!make_unit) return m;
    return glm::dot(m, m) > 0 ? glm::normalize(m) : glm::dvec3(0, 0, 1);
}

/// A place's difference from a homogeneous point, or the way to it where that is at infinity.
glm::dvec3 way_to(const glm::dvec4& light, const glm::dvec3& eye, const glm::dvec3& relative) {
    return (glm::dvec3(light) - light.w * eye) - light.w * relative;
}

/// `to_light` of unit length within `turn`, the way to it `length` long.
Intervals radiance_at(const Scene& scene, const glm::dvec3& to_light, double turn, double length) {
    const Light& light = chosen_light(scene);
    Interval strength = around(1);
    if (light.kind == Light::Kind::spot) {
        // Rounded are the axis, the cosine's products and its two sums, the outer cone's cosine,
        // the difference (up to 2) and the product with the scale: 8 v, before the scale.
        const SpotCone cone = spot_cone(light);
        const double cosine = -glm::dot(to_light, light.direction);
        strength =
            squared(clamped(cone.scale * around(cosine - cone.cos_outer, turn + 8 * v), 0, 1));
    }
    const bool has_place = light.kind != Light::Kind::directional;
    if (scene.inverse_square && has_place)
        strength = 1 / (length * length) * strength * around(1, 2 * turn + 4 * v);
    const glm::dvec3 color = scene.inverse_square ? light.color * light.intensity : light.color;
    return {color.x * strength, color.y * strength, color.z * strength};
}

Intervals decal_at(const Scene& scene, const InputPoint& point, const Material& material,
                   Interval& gloss) {
    glm::dvec4 texel(1);
    if (material.decal != no_texture) {
        const TextureImage& map = scene.textures[material.decal];
        const glm::dvec2 at = point.decal_off + interpolated(point.shading.weights, [&](int k) {
                                  return glm::dvec2(surface_of(scene, point.triangle, k).decal_at);
                              });
        texel = mixed<glm::dvec4>(map, map.texels, at, [](const glm::dvec4& t) { return t; });
    }
    // Three roundings of a mixture along rows, as many between them, and the factor's two.
    gloss = material.gloss_in_alpha ? around(texel.a, 8 * v * std::abs(texel.a)) : around(1);
    Intervals decal;
    for (int k = 0; k < 3; ++k) {
        const double channel = material.color[k] * texel[k];
        decal[static_cast<std::size_t>(k)] = around(channel, 8 * v * std::abs(channel));
    }
    return decal;
}

} // namespace

LightingTables make_lighting_tables(const Scene& scene, const ColorModel& model) {
    LightingTables tables;
    tables.scene = &scene;
    tables.model = model;
    tables.bumps.resize(scene.materials.size());
    tables.slopes.resize(scene.materials.size());
    // Of the materials that are drawn: an unused one may have bumps that cannot be had in the form.
    for (const Mesh& mesh : scene.meshes) {
        const Material& material = scene.materials[mesh.material];
        std::optional<BumpTexels>& bumps = tables.bumps[mesh.material];
        Image<glm::dvec2>& slopes = tables.slopes[mesh.material];
        if (material.bump == Bump::none || bumps) continue;
        bumps = expected_bump_texels(scene, material, model.bump_form);
        if (bumps->form == BumpForm::height_field)
            slopes = expected_slopes(scene.textures[material.bump_map], bumps->scale);
    }
    assert(model.reflects == scene.environment.has_value());
    assert(!model.reflects || model.axes == ColorModel::Axes::world); // the environment's
    if (model.normalisation == Normalisation::cube_map) tables.cube = expected_normalisation_cube();
    return tables;
}

LightingInputs true_inputs(const LightingTables& tables, const InputPoint& point) {
    const Scene& scene = *tables.scene;
    const Shading& shading = point.shading;
    const TangentFrame frame = frame_at(point);
    LightingInputs inputs;
    inputs.light = into(frame, around(shading.to_light));
    inputs.half = into(frame, around(shading.half));
    inputs.bump = into(frame, around(shading.bumped));
    // The frame holds no tangents where there are no bumps to be told apart by them.
    if (material_of(scene, point.triangle).bump == Bump::none) inputs.bump = around({0, 0, 1});
    inputs.radiance = around(shading.light);
    inputs.decal = around(shading.decal);
    inputs.gloss = around(shading.gloss);
    inputs.reflection = around(shading.reflection_color);
    inputs.specular = material_of(scene, point.triangle).specular;
    inputs.ambient = scene.ambient;
    inputs.lit = shading.lit;
    return inputs;
}

LightingInputs claimed_inputs(const LightingTables& tables, const InputPoint& point, double share) {
    const Scene& scene = *tables.scene;
    const Shading& shading = point.shading;
    const Material& material = material_of(scene, point.triangle);
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    const glm::dvec3& eye = scene.camera.eye;
    const auto to_light = [&](int k) {
        return way_to(light, eye, corner(scene, point.triangle, k) - eye);
    };
    const auto from_eye = [&](int k) { return corner(scene, point.triangle, k) - eye; };
    const glm::dvec3 way = way_to(light, eye, shading.point);
    const double way_off = share * largest_length(to_light);
    const glm::dmat3 axes = tables.model.axes == ColorModel::Axes::eye
                                ? view_from_eye_relative(scene.camera)
                                : glm::dmat3(1);
    const Intervals l = normalised(tables, axes * way, way_off);
    const double eye_off = share * largest_length(from_eye);
    const Intervals e = normalised(tables, -(axes * shading.point), eye_off);
    const Intervals both = sum(l, e);
    const TangentFrame frame = turned(axes, frame_at(scene, point, share));
    LightingInputs inputs;
    inputs.light = into(frame, l);
    inputs.half = into(frame, normalised(tables, middle(both), radius_of(both) + v));
    const glm::dvec2 at = point.bump_off + interpolated(shading.weights, [&](int k) {
                              return glm::dvec2(surface_of(scene, point.triangle, k).bump_at);
                          });
    inputs.bump = around(bump_at(tables, material, at), 12 * v);
    inputs.radiance =
        radiance_at(scene, unit_or_zero(way), way_off / glm::length(way) + 4 * v, glm::length(way));
    inputs.decal = decal_at(scene, point, material, inputs.gloss);
    if (tables.model.reflects) {
        const double distance = glm::length(shading.point);
        const Intervals to_eye = around(-shading.point / distance, eye_off / distance + 4 * v);
        const Intervals shown =
            environment_at(*scene.environment, out_of(frame, inputs.bump), to_eye);
        for (std::size_t k = 0; k < 3; ++k)
            inputs.reflection[k] =
                material.reflectance[static_cast<int>(k)] * shown[k] * inputs.gloss;
    }
    inputs.specular = material.specular;
    inputs.ambient = scene.ambient;
    inputs.lit = shading.lit;
    return inputs;
}

CoordinateFreedom coordinate_freedom(const Scene& scene, std::uint32_t triangle, double share) {
    CoordinateFreedom freedom;
    for (int k = 0; k < 3; ++k) {
        const Surface& surface = surface_of(scene, triangle, k);
        freedom.bump = glm::max(freedom.bump, glm::abs(glm::dvec2(surface.bump_at)));
        freedom.decal = glm::max(freedom.decal, glm::abs(glm::dvec2(surface.decal_at)));
    }
    freedom.bump *= share + 4 * v;
    freedom.decal *= share + 4 * v;
    return freedom;
}

} // namespace shadowproof
