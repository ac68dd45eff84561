#include "compare/driver/lighting/error_budget.h"

#include "compare/driver/lighting/lighting_ranges.h"
#include "compare/driver/lighting/lighting_tables.h"
#include "compare/driver/lighting/stretched_bumps.h"
#include "compare/driver/lighting/texel_ranges.h"
#include "scenes/driver.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof {

namespace {

constexpr double v = float_roundoff;

/// Half a step of a byte that holds a number between -1 and 1.
constexpr double half_step = 1 / 255.0;

/// How far a place on a face may lie past the last texel's centre, still in that texel.
double past_last_centre(int size, const Interval& along) {
    const double furthest = std::max(std::abs(along.low), std::abs(along.high));
    return std::clamp(furthest - (1 - 1.0 / size), 0.0, 1.0 / size);
}

/// A unit vector as the technique normalises it; `vector`: the truth's.
VectorRange normalised(const LightingTables& tables, VectorRange vector, const glm::dmat3& axes) {
    switch (tables.model.normalisation) {
    case Normalisation::exact:
        vector.distance += 4 * v;
        break;
    case Normalisation::newton_raphson: {
        // Half of its range to either side of the middle.
        const LengthError error = newton_raphson_error(tables.model.newton_steps);
        for (Interval& component : vector.box)
            component = (1 + (error.low + error.high) / 2) * component;
        vector.distance += (error.high - error.low) / 2 + 8 * v;
        break;
    }
    case Normalisation::cube_map: {
        const glm::dvec3 looked_at = axes * middle(vector.box);
        vector.distance += cube_budget(tables.cube.size, around(looked_at, radius(vector))) +
                           std::sqrt(3.0) * cube_lookup_error(tables.cube.size);
        break;
    }
    }
    return vector;
}

/// A pixel's surface, as bumps are budgeted on it.
struct BumpPlace {
    const InputPoint& point;
    const TangentFrame& frame; ///< in world axes
    const Material& material;

    const PlaceRange& at() const { return point.interpolated.bump_at; }
};

/// m of slopes as the asset has them.
VectorRange normal_of(const LightingTables& tables, const BumpPlace& place,
                      const RangeOf<glm::dvec2>& slope, const TangentFrame& frame) {
    if (place.material.height_in_space)
        return normal_over_texel_sides(*tables.scene, place.point.triangle, frame,
                                       place.point.shading.side, slope);
    return {{-1 * slope[0], slope[1], around(1)}};
}

/// The perturbed normal from the asset: m, filtered in the asset's own form.
VectorRange mixed_as_given(const LightingTables& tables, const BumpPlace& place) {
    const Material& material = place.material;
    const PlaceRange& at = place.at();
    if (material.bump == Bump::height_field)
        return normal_of(tables, place, slope_range(tables, material, at), place.frame);
    const TextureImage& map = tables.scene->textures[material.bump_map];
    constexpr Interval any{-1, 1};
    Intervals m = mixed_range(
        turning_places(map.wrap_s, map.texels.width, at[0]),
        turning_places(map.wrap_t, map.texels.height, at[1]),
        [&](int x, int y) { return 2.0 * glm::dvec3(map.texels.at(x, y)) - 1.0; },
        Intervals{any, any, any});
    m[0] = material.bump_scale * m[0];
    m[1] = material.bump_scale * m[1];
    return {m};
}

/// m at one of the asset's texels.
glm::dvec3 texel_as_given(const LightingTables& tables, const BumpPlace& place, int x, int y) {
    const Material& material = place.material;
    if (material.bump == Bump::height_field) {
        const auto index = static_cast<std::size_t>(&material - tables.scene->materials.data());
        return middle(normal_of(tables, place, range_of(tables.slopes[index].at(x, y)),
                                centre_frame(place.point.shading))
                          .box);
    }
    const glm::vec4& texel = tables.scene->textures[material.bump_map].texels.at(x, y);
    return {material.bump_scale * (2 * double{texel.r} - 1),
            material.bump_scale * (2 * double{texel.g} - 1), 2 * double{texel.b} - 1};
}

/// The asset's texels, each converted into the form by `form_of`, and then filtered.
template <class FormOf>
VectorRange mixed_in_form(const LightingTables& tables, const BumpPlace& place,
                          const FormOf& form_of, const Intervals& whole) {
    const TextureImage& map = tables.scene->textures[place.material.bump_map];
    return {mixed_range(
        turning_places(map.wrap_s, map.texels.width, place.at()[0]),
        turning_places(map.wrap_t, map.texels.height, place.at()[1]),
        [&](int x, int y) { return form_of(texel_as_given(tables, place, x, y)); }, whole)};
}

/// If the asset is in the same form, filtering is the truth's own.
VectorRange bump_budget(const LightingTables& tables, const BumpPlace& place) {
    const Material& material = place.material;
    if (material.bump == Bump::none) return {around(glm::dvec3(0, 0, 1))};
    const auto index = static_cast<std::size_t>(&material - tables.scene->materials.data());
    const BumpForm form = tables.bumps[index]->form;
    const bool heights = material.bump == Bump::height_field;
    const VectorRange given = mixed_as_given(tables, place);
    const VectorRange truth = unit(given);
    if (form == (heights ? BumpForm::height_field : BumpForm::normal_map)) return truth;
    if (form == BumpForm::derivatives) {
        // Two slopes, each half a step off, of bytes between -range and range.
        const double range = tables.bumps[index]->slope_range;
        const Interval any{-range, range};
        if (material.height_in_space) {
            RangeOf<glm::dvec2> slope = slope_range(tables, material, place.at());
            const double off = range * half_step * tables.bumps[index]->texel_side;
            for (Interval& along : slope) along = widened(along, off);
            return hull(truth, unit(normal_of(tables, place, slope, place.frame)));
        }
        VectorRange slopes =
            heights ? given
                    : mixed_in_form(tables, place, [](const glm::dvec3& m) { return m / m.z; },
                                    {any, any, around(1)});
        slopes.distance += std::sqrt(2.0) * range * half_step;
        return hull(truth, unit(slopes));
    }
    constexpr Interval any{-1, 1};
    VectorRange normals = mixed_in_form(tables, place,
                                        [](const glm::dvec3& m) {
                                            const double length = glm::length(m);
                                            return length > 0 ? m / length : glm::dvec3(0, 0, 1);
                                        },
                                        {any, any, any});
    normals.distance += form == BumpForm::indexed ? octahedral_error : std::sqrt(3.0) * half_step;
    return hull(truth, unit(normals));
}

} // namespace

// Texels are off by half a step a component, so by the root of 3 of these at most, and so is a
// mixture of them. Between texels' centres, h = 2 / size apart, a mixture is off the unit vector by
// at most h^2 / 8 times the size of its second derivative, for each of both axes. Of u(s, t) =
// (1, s, t) / l, with l its length and a = u . e_s: u_s = (e_s - a u) / l, whose size is
// sqrt(1 - a^2) / l, and the size of u_ss is sqrt((1 - a^2) (1 + 3 a^2)) / l^2, which nowhere
// exceeds 1. Past the last texel's centre u goes on and the lookup does not: u_s times the way.
double cube_budget(int size, const Intervals& vectors) {
    double furthest = 0;
    visit_faces(vectors, [&](std::size_t /*face*/, const Interval& s, const Interval& t) {
        const double past_s = past_last_centre(size, s);
        const double past_t = past_last_centre(size, t);
        if (past_s == 0 && past_t == 0) return;
        // u_s is largest where s and t are smallest.
        const auto least_square = [](const Interval& a, double past, int n) {
            const double least = past > 0 ? 1 - 1.0 / n : std::max({a.low, -a.high, 0.0});
            return least * least;
        };
        const double ss = least_square(s, past_s, size);
        const double tt = least_square(t, past_t, size);
        const double square = 1 + ss + tt;
        const double along_s = past_s * std::sqrt(1 + tt) / square;
        const double along_t = past_t * std::sqrt(1 + ss) / square;
        furthest = std::max(furthest, along_s + along_t);
    });
    const double h = 2.0 / size;
    return std::sqrt(3.0) * half_step + 2 * h * h / 8 + furthest;
}

LightingInputs budgeted_inputs(const LightingTables& tables, const InputPoint& point) {
    const Scene& scene = *tables.scene;
    const Interpolated& at = point.interpolated;
    const Material& material = material_of(scene, point.triangle);
    const glm::dmat3 axes = lighting_axes(scene, tables.model);
    const TangentFrame frame = frame_range(point);
    const double way = glm::length(at.to_light);
    const double distance = glm::length(at.from_eye);
    const VectorRange to_light{around(at.to_light / way), 0, turned_by(at.to_light_off / way)};
    const VectorRange to_eye{around(-at.from_eye / distance), 0,
                             turned_by(at.from_eye_off / distance)};
    const VectorRange light = normalised(tables, to_light, axes);
    VectorRange between = light + normalised(tables, to_eye, axes);
    between.box = widened(between.box, v);
    const VectorRange half = unit(between);
    LightingInputs inputs;
    inputs.light = into(frame, light);
    inputs.half = into(frame, normalised(tables, half, axes));
    inputs.bump = bump_budget(tables, {point, frame, material});
    inputs.bump.distance += perturbed_normal_roundings * v;
    add_surroundings(inputs, point, frame, tables.model.reflects);
    return inputs;
}

} // namespace shadowproof
