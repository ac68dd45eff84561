#include "compare/driver/lighting/lighting_ranges.h"

#include "scenes/driver.h"
#include "scenes/spot_cone.h"
#include "scenes/surface/tangents.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace shadowproof {

namespace {

constexpr double v = float_roundoff;

/// Bounds of any texel of a picture.
constexpr Interval any_texel{0, 1};

/// What the environment shows along any of some directions.
// Roundings of the place on the face, as if the direction moved: the quotient (v), that plus 1 and
// what is left of it among `size` texels (6 v). Of the mixture of texels, which are at most 1,
// along rows and between them: 8 v.
Intervals environment_range(const CubeFaces<glm::vec3>& faces, const Intervals& directions) {
    return widened(cube_range(faces, widened(directions, 7 * v), {any_texel, any_texel, any_texel}),
                   8 * v);
}

} // namespace

const Material& material_of(const Scene& scene, std::uint32_t triangle) {
    return scene.materials[scene.meshes[mesh_of(scene, triangle)].material];
}

TangentFrame centre_frame(const Shading& shading) {
    TangentFrame frame;
    frame.normal = shading.normal;
    frame.tangent = shading.side * shading.tangent;
    frame.bitangent =
        shading.side * shading.hand * glm::cross(shading.side * shading.normal, shading.tangent);
    return frame;
}

// T is t - N (N . t), normalised. Before it is normalised it is off by the error of t, by twice the
// error of N times the length of t, as N stands there twice, and by 8 v of that length for
// rounding. Normalising adds 8 v to N and to T. An N that vanishes keeps the direction that the
// definition gives it instead, and a surface without bumps has no T. Where t runs along N, nothing
// but rounding is left of it: T may be anything, 0 among it.
TangentFrame frame_range(const InputPoint& point) {
    const Shading& shading = point.shading;
    const Interpolated& at = point.interpolated;
    TangentFrame frame = centre_frame(shading);
    const double normal_length = glm::length(at.normal);
    if (normal_length > 0) frame.normal = shading.side * at.normal / normal_length;
    frame.normal_off = turned_by(at.normal_off / normal_length) + 8 * v;
    if (shading.tangent == glm::dvec3(0)) return frame;
    const glm::dvec3 n = shading.side * frame.normal;
    const glm::dvec3 across = at.tangent - n * glm::dot(n, at.tangent);
    const double across_length = glm::length(across);
    const double off = at.tangent_off + (2 * frame.normal_off + 8 * v) * glm::length(at.tangent);
    const bool any = !(across_length > off);
    const glm::dvec3 t = any ? any_tangent(n) : across / across_length;
    frame.tangent = shading.side * t;
    frame.bitangent = shading.side * shading.hand * glm::cross(n, t);
    frame.tangent_off = any ? 2 : turned_by(off / across_length) + 8 * v;
    frame.bitangent_off = frame.tangent_off + frame.normal_off;
    return frame;
}

TangentFrame rotated(const glm::dmat3& axes, TangentFrame frame) {
    frame.tangent = axes * frame.tangent;
    frame.bitangent = axes * frame.bitangent;
    frame.normal = axes * frame.normal;
    return frame;
}

glm::dmat3 lighting_axes(const Scene& scene, const ColorModel& model) {
    return model.axes == ColorModel::Axes::eye ? view_from_eye_relative(scene.camera)
                                               : glm::dmat3(1);
}

// A frame whose axes are off is a rotated one: N is moved to its place, and then T about it. The
// products' sums round four times, of vectors that are at most 1 long.
//
// Without tangents the components along them are 0, and no longer tell how far the vector is from
// N, on which it depends what a rotation does: it is rotated before.
VectorRange into(const TangentFrame& frame, const VectorRange& vector) {
    if (frame.tangent == glm::dvec3(0)) {
        const Interval along_normal = dot(vector, {around(frame.normal), 0, frame.normal_off});
        return {{around(0), around(0), widened(along_normal, 4 * v)}};
    }
    const double turn = frame.normal_off + frame.tangent_off;
    const auto along = [&](const glm::dvec3& axis) {
        const Interval carried = dot(vector.box, around(axis));
        return turn > 0 ? widened(carried, 4 * v) : carried;
    };
    return {{along(frame.tangent), along(frame.bitangent), along(frame.normal)},
            vector.distance,
            vector.turn + turn};
}

Intervals out_of(const TangentFrame& frame, const VectorRange& vector) {
    const Intervals bump = box_around(vector);
    const Intervals tangent = around(frame.tangent, frame.tangent_off);
    const Intervals bitangent = around(frame.bitangent, frame.bitangent_off);
    const Intervals normal = around(frame.normal, frame.normal_off);
    Intervals carried;
    for (std::size_t k = 0; k < 3; ++k)
        carried[k] =
            widened(bump[0] * tangent[k] + bump[1] * bitangent[k] + bump[2] * normal[k], 4 * v);
    return carried;
}

Intervals radiance_range(const Scene& scene, const Interpolated& interpolated) {
    const Light& light = chosen_light(scene);
    const double length = glm::length(interpolated.to_light);
    const double share = interpolated.to_light_off / length;
    Interval strength = around(1);
    if (light.kind == Light::Kind::spot) {
        // Rounded are the way's unit vector (4 v), the axis, the cosine's products and its two
        // sums, the outer cone's cosine, the difference (up to 2) and the product with the scale:
        // 12 v, before the scale.
        const SpotCone cone = spot_cone(light);
        const double cosine = -glm::dot(interpolated.to_light / length, light.direction);
        strength = squared(
            clamped(cone.scale * around(cosine - cone.cos_outer, turned_by(share) + 12 * v), 0, 1));
    }
    if (scene.inverse_square && light.kind != Light::Kind::directional) {
        // Rounded are the square (4 v) and the quotient (v).
        const Interval away = length * around(1, share + 3 * v);
        strength = strength *
                   Interval{1 / (away.high * away.high), 1 / std::pow(std::max(away.low, 0.0), 2)};
    }
    const glm::dvec3 color = scene.inverse_square ? light.color * light.intensity : light.color;
    return {color.x * strength, color.y * strength, color.z * strength};
}

DecalRange decal_range(const Scene& scene, const Material& material, const PlaceRange& at) {
    RangeOf<glm::dvec4> texel = range_of(glm::dvec4(1));
    if (material.decal != no_texture) {
        const TextureImage& map = scene.textures[material.decal];
        texel = mixed_range(
            turning_places(map.wrap_s, map.texels.width, at[0]),
            turning_places(map.wrap_t, map.texels.height, at[1]),
            [&](int x, int y) { return glm::dvec4(map.texels.at(x, y)); },
            RangeOf<glm::dvec4>{any_texel, any_texel, any_texel, any_texel});
    }
    // Three roundings of a mixture along rows, as many between them, and the factor's two.
    const auto rounded = [](const Interval& a) {
        return widened(a, 8 * (v * std::abs(a.high) + float_underflow));
    };
    DecalRange decal;
    if (material.gloss_in_alpha) decal.gloss = rounded(texel[3]);
    for (std::size_t k = 0; k < 3; ++k)
        decal.color[k] = rounded(material.color[static_cast<int>(k)] * texel[k]);
    return decal;
}

// Roundings of R: of N' . V (3 v), twice that times N' (2 v), the difference (3 v: R is at most 3
// long before they cancel).
Intervals reflection_range(const Scene& scene, const Material& material, const Intervals& normal,
                           const Interpolated& interpolated, const Interval& gloss) {
    const double distance = glm::length(interpolated.from_eye);
    const Intervals to_eye = around(-interpolated.from_eye / distance,
                                    turned_by(interpolated.from_eye_off / distance) + 4 * v);
    const Interval cosine = dot(normal, to_eye);
    Intervals mirrored;
    for (std::size_t k = 0; k < 3; ++k)
        mirrored[k] = widened(2 * cosine * normal[k] + -1 * to_eye[k], 8 * v);
    Intervals shown = environment_range(*scene.environment, mirrored);
    for (std::size_t k = 0; k < 3; ++k)
        shown[k] = material.reflectance[static_cast<int>(k)] * shown[k] * gloss;
    return shown;
}

void add_surroundings(LightingInputs& inputs, const InputPoint& point, const DecalRange& decal) {
    const Scene& scene = point.scene;
    inputs.radiance = radiance_range(scene, point.interpolated);
    inputs.decal = decal.color;
    inputs.gloss = decal.gloss;
    inputs.specular = material_of(scene, point.triangle).specular;
    inputs.ambient = scene.ambient;
    inputs.highlight = scene.highlight;
    inputs.lit = point.shading.lit;
}

void add_surroundings(LightingInputs& inputs, const InputPoint& point, const TangentFrame& frame,
                      bool reflects) {
    const Interpolated& at = point.interpolated;
    const Material& material = material_of(point.scene, point.triangle);
    add_surroundings(inputs, point, decal_range(point.scene, material, at.decal_at));
    if (reflects)
        inputs.reflection =
            reflection_range(point.scene, material, out_of(frame, inputs.bump), at, inputs.gloss);
}

} // namespace shadowproof
