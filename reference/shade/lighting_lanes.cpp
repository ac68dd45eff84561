#include "reference/shade/lighting_lanes.h"

// Highway compiles what follows once for each instruction set, then chooses when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reference/shade/lighting_lanes.cpp"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace shadowproof::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Doubles = hn::CappedTag<double, packet_size>;
using Number = hn::Vec<Doubles>;
using Mask = hn::Mask<Doubles>;

constexpr Doubles doubles;

Number number(double value) {
    return hn::Set(doubles, value);
}
Number load(const Lanes<double>& values, int i) {
    return hn::Load(doubles, values.data() + i);
}
void store(Number value, Lanes<double>& values, int i) {
    hn::Store(value, doubles, values.data() + i);
}

/// As many vectors as a Number has lanes.
struct Vectors {
    Number x, y, z;
};

Vectors load(const LaneVectors& v, int i) {
    return {load(v.x, i), load(v.y, i), load(v.z, i)};
}
void store(const Vectors& v, LaneVectors& to, int i) {
    store(v.x, to.x, i);
    store(v.y, to.y, i);
    store(v.z, to.z, i);
}
Vectors vectors(const glm::dvec3& v) {
    return {number(v.x), number(v.y), number(v.z)};
}
Vectors operator+(const Vectors& a, const Vectors& b) {
    return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
Vectors operator-(const Vectors& a, const Vectors& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
Vectors operator*(const Vectors& a, Number s) {
    return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)};
}
Number dot(const Vectors& a, const Vectors& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
Vectors cross(const Vectors& a, const Vectors& b) {
    return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)),
            hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
            hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
Vectors select(Mask mask, const Vectors& yes, const Vectors& no) {
    return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
            hn::IfThenElse(mask, yes.z, no.z)};
}

Number reciprocal_root(Number square) {
    return hn::Div(number(1), hn::Sqrt(square));
}

/// Normalised; zero where the length is zero.
Vectors unit(const Vectors& v) {
    const Number square = dot(v, v);
    return v * hn::IfThenElseZero(hn::Gt(square, number(0)), reciprocal_root(square));
}

/// any_tangent (tangents.h) for each lane.
Vectors any_tangents(const Vectors& normal) {
    const Number x = hn::Abs(normal.x);
    const Number y = hn::Abs(normal.y);
    const Number z = hn::Abs(normal.z);
    const Mask first = hn::And(hn::Le(x, y), hn::Le(x, z));
    const Mask second = hn::AndNot(first, hn::Le(y, z));
    const Mask third = hn::Not(hn::Or(first, second));
    const Number one = number(1);
    const Vectors axis{hn::IfThenElseZero(first, one), hn::IfThenElseZero(second, one),
                       hn::IfThenElseZero(third, one)};
    return unit(axis - normal * dot(normal, axis));
}

Vectors unit_tangents(const Vectors& interpolated, const Vectors& normal) {
    const Vectors across = interpolated - normal * dot(normal, interpolated);
    const Number square = dot(across, across);
    const Mask has_length = hn::Gt(square, number(0));
    const Vectors tangent = across * reciprocal_root(square);
    if (hn::AllTrue(doubles, has_length)) return tangent;
    return select(has_length, tangent, any_tangents(normal));
}

Number clamp01(Number value) {
    return hn::Min(hn::Max(value, number(0)), number(1));
}

/// Step 3 for heights in units of space.
Vectors normals_off_gradients(const LightingLanes& lanes, const Vectors& normal, int i) {
    return unit(normal - load(lanes.gradient, i));
}

/// Step 3, and the rotation of step 4.
Vectors bumped_normals(const LightingLanes& lanes, const Vectors& normal, int i) {
    const Vectors tangent = unit_tangents(load(lanes.tangent, i), normal);
    const Vectors bitangent = cross(normal, tangent) * load(lanes.hand, i);
    const Vectors given = load(lanes.bump, i);
    const Number square = dot(given, given);
    const Vectors m =
        select(hn::Gt(square, number(0)), given * reciprocal_root(square), vectors({0, 0, 1}));
    Vectors bumped = tangent * m.x + bitangent * m.y + normal * m.z;
    const Mask in_space = hn::Gt(load(lanes.in_space, i), number(0));
    if (!hn::AllFalse(doubles, in_space))
        bumped = select(in_space, normals_off_gradients(lanes, normal, i), bumped);
    return bumped * load(lanes.side, i);
}

/// Steps 5 (L alone) and 6.
Vectors find_light(const LaneLight& light, LightingLanes& lanes, int i) {
    const Vectors to = vectors(glm::dvec3(light.to));
    Number strength = number(1);
    if (light.to.w == 0) {
        store(strength, lanes.strength, i);
        return to;
    }
    const Vectors way = to - load(lanes.point, i);
    const Vectors to_light = unit(way);
    if (light.inverse_square) strength = hn::Div(strength, dot(way, way));
    if (light.spot) {
        const Number cosine = hn::Neg(dot(to_light, vectors(light.axis)));
        const Number within =
            clamp01(hn::Mul(hn::Sub(cosine, number(light.cos_outer)), number(light.cone_scale)));
        strength = hn::Mul(strength, hn::Mul(within, within));
    }
    store(strength, lanes.strength, i);
    return to_light;
}

Number self_shadow(const Vectors& v, const Vectors& normal) {
    return clamp01(hn::Mul(number(8), dot(v, normal)));
}

void light_some(const LaneLight& light, LightingLanes& lanes, int i) {
    const Vectors front_normal = unit(load(lanes.normal, i));
    const Vectors bumped = bumped_normals(lanes, front_normal, i);
    const Vectors normal = front_normal * load(lanes.side, i);
    const Vectors to_light = find_light(light, lanes, i);
    const Vectors half = unit(to_light - unit(load(lanes.direction, i)));
    store(normal, lanes.normal, i);
    store(bumped, lanes.bumped, i);
    store(to_light, lanes.to_light, i);
    store(half, lanes.half, i);
    const Number zero = number(0);
    const Number of_light = self_shadow(to_light, normal);
    const Number of_half = self_shadow(half, normal);
    store(of_light, lanes.self_shadow_light, i);
    store(of_half, lanes.self_shadow_half, i);
    store(hn::Mul(of_light, hn::Max(dot(to_light, bumped), zero)), lanes.diffuse, i);
    Number specular = hn::Max(dot(half, bumped), zero);
    for (int k = 0; k < light.highlight.squarings; ++k) specular = hn::Mul(specular, specular);
    if (by_light(light.highlight.shadow)) specular = hn::Mul(of_light, specular);
    if (by_half_angle(light.highlight.shadow)) specular = hn::Mul(of_half, specular);
    store(specular, lanes.specular, i);
}

} // namespace

void light_lanes(const LaneLight& light, LightingLanes& lanes) {
    for (int i = 0; i < packet_size; i += static_cast<int>(hn::Lanes(doubles)))
        light_some(light, lanes, i);
}

} // namespace shadowproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shadowproof {

HWY_EXPORT(light_lanes);

void light_lanes(const LaneLight& light, LightingLanes& lanes) {
    HWY_DYNAMIC_DISPATCH(light_lanes)(light, lanes);
}

} // namespace shadowproof
#endif
