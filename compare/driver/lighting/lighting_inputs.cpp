#include "compare/driver/lighting/lighting_inputs.h"

#include "compare/driver/lighting/filtered_ranges.h"
#include "compare/driver/lighting/lighting_ranges.h"
#include "compare/driver/lighting/lighting_tables.h"
#include "compare/driver/lighting/stretched_bumps.h"
#include "compare/driver/lighting/vertex_vectors.h"
#include "scenes/driver.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

namespace shadowproof {

namespace {

constexpr double v = float_roundoff;

/// Lomont's reciprocal square root (2003): a guess by halving the exponent, then steps of Newton
/// and Raphson; newton_raphson_error has its relative error.
double newton_raphson_root(double square, int steps) {
    const auto x = static_cast<float>(square);
    const auto bits = std::bit_cast<std::uint32_t>(x);
    double root = std::bit_cast<float>(0x5f3759dfU - (bits >> 1U));
    for (int step = 0; step < steps; ++step) root *= 1.5 - 0.5 * square * root * root;
    return root;
}

/// A vector as the technique normalises it, in its own axes.
// Roundings: of the square (3 v), its root (v), the quotient (v): 4 v of a length of 1.
//
// A Newton-Raphson step: a guess (1 + e) / sqrt(x), |e| at most 0.0344, becomes 1 - 1.5 e^2 -
// 0.5 e^3 of a length of 1. The guess falls between a quarter as fast as x, in its share, and as
// fast, so that e moves by at most half of what x does, which is twice what the length does:
// without a step the length comes out off by 1 + e < 1.04 of its share, and with one by (3 e + 1.5
// e^2) (1 + e) = 0.11 of it at most. Further steps shrink that, and the roundings of earlier ones,
// by 3 e + 1.5 e^2 again. A step has three roundings (of y^2 and of its product with x, halved, and
// of the difference, together 2 v; of the last product, v); so all steps come to 3 v / (1 - 0.11)
// at most, the square to 1.5 v, as its root is taken, and the vector's product to v: below 8 v.
// Without a step the square's 3 v come through whole, which makes 4 v.
VectorRange normalised(const LightingTables& tables, const ColorModel& model,
                       const VectorRange& range) {
    const glm::dvec3 vector = middle(range.box);
    const double length = glm::length(vector);
    if (!(length > 0)) return {around(glm::dvec3(0)), 1};
    const double turn = turned_by(radius(range) / length);
    switch (model.normalisation) {
    case Normalisation::exact:
        break;
    case Normalisation::newton_raphson:
        return {around(newton_raphson_root(length * length, model.newton_steps) * vector),
                (model.newton_steps == 0 ? 1.04 : 0.11) * turn + 8 * v, turn};
    case Normalisation::cube_map: {
        constexpr Interval any_byte{0, 255};
        Intervals looked_up =
            cube_range(tables.cube.faces, box_around(range), {any_byte, any_byte, any_byte});
        for (Interval& component : looked_up)
            component =
                widened(2.0 / 255 * component + around(-1), cube_lookup_error(tables.cube.size));
        return {looked_up};
    }
    }
    return {around(vector / length), 4 * v, turn};
}

/// What a table's texels come to over a range of places, as `of` decodes them.
template <class Of, class Range>
Range texels_range(const TextureImage& map, const Image<glm::vec4>& texels, const PlaceRange& at,
                   const Of& of, const Range& whole) {
    return mixed_range(
        turning_places(map.wrap_s, texels.width, at[0]),
        turning_places(map.wrap_t, texels.height, at[1]),
        [&](int x, int y) { return of(glm::dvec4(texels.at(x, y))); }, whole);
}

Intervals normal_of(const RangeOf<glm::dvec2>& slope) {
    return {-1 * slope[0], slope[1], around(1)};
}

const BumpTexels& bumps_of(const LightingTables& tables, const Material& material) {
    const auto index = static_cast<std::size_t>(&material - tables.scene->materials.data());
    return *tables.bumps[index];
}

/// Slopes per texel of a form that holds slopes, in texels; none of other forms.
std::optional<RangeOf<glm::dvec2>> stored_slopes(const LightingTables& tables,
                                                 const Material& material, const PlaceRange& at) {
    const BumpTexels& bumps = bumps_of(tables, material);
    if (bumps.form == BumpForm::height_field) {
        RangeOf<glm::dvec2> slopes = slope_range(tables, material, at);
        if (material.height_in_space)
            for (Interval& slope : slopes) slope = (1 / bumps.texel_side) * slope;
        return slopes;
    }
    if (bumps.form != BumpForm::derivatives) return std::nullopt;
    const Interval any{-bumps.slope_range, bumps.slope_range};
    return texels_range(
        tables.scene->textures[material.bump_map], bumps.texels, at,
        [&](const glm::dvec4& texel) {
            return bumps.slope_range * (2.0 * glm::dvec2(texel) - 1.0);
        },
        RangeOf<glm::dvec2>{any, any});
}

/// The largest slope of a texel, in texels.
double largest_slope(const BumpTexels& bumps) {
    // Half of what heights between 0 and 1 differ by.
    return bumps.form == BumpForm::derivatives ? bumps.slope_range : 0.5 * std::abs(bumps.scale);
}

/// N' of a technique that perturbs normals by slopes over texels of their true sides. Floats, of
/// the largest texel's slope: its difference, the scale and their product (3 v), the mixture's six
/// roundings along rows and between them, the mean side and its product with the slope (2 v). Skew
/// can make much of them.
VectorRange bump_in_space(const InputPoint& point, const Scene& scene, const TangentFrame& frame,
                          const RangeOf<glm::dvec2>& slopes, const BumpTexels& bumps) {
    const double rounding = 12 * v * bumps.texel_side * largest_slope(bumps);
    RangeOf<glm::dvec2> in_space;
    for (std::size_t k = 0; k < 2; ++k)
        in_space[k] = widened(bumps.texel_side * slopes[k], rounding);
    return unit(
        normal_over_texel_sides(scene, point.triangle, frame, point.shading.side, in_space));
}

/// m of the technique: normalised if it is made from slopes or if lighting is in floats throughout;
/// else as filtered. `frame`: in world axes.
VectorRange bump_range(const LightingTables& tables, const InputPoint& point,
                       const TangentFrame& frame) {
    const Material& material = material_of(*tables.scene, point.triangle);
    if (material.bump == Bump::none) return {around(glm::dvec3(0, 0, 1))};
    const PlaceRange& at = point.interpolated.bump_at;
    constexpr Interval any_component{-1, 1};
    const BumpTexels& bumps = bumps_of(tables, material);
    const TextureImage& map = tables.scene->textures[material.bump_map];
    const bool in_floats = tables.model.arithmetic == ColorModel::Arithmetic::floating;
    if (const auto slopes = stored_slopes(tables, material, at)) {
        const bool in_space =
            material.height_in_space && tables.model.axes == ColorModel::Axes::eye;
        return in_space ? bump_in_space(point, *tables.scene, frame, *slopes, bumps)
                        : unit({normal_of(*slopes)});
    }
    if (bumps.form == BumpForm::indexed) {
        const VectorRange mixed{texels_range(
            map, bumps.texels, at,
            [](const glm::dvec4& texel) {
                return expected_normal(static_cast<std::uint16_t>(texel.r));
            },
            Intervals{any_component, any_component, any_component})};
        return in_floats ? unit(mixed) : mixed;
    }
    Intervals mixed = texels_range(
        map, bumps.texels, at,
        [](const glm::dvec4& texel) { return 2.0 * glm::dvec3(texel) - 1.0; },
        Intervals{any_component, any_component, any_component});
    mixed[0] = bumps.scale * mixed[0];
    mixed[1] = bumps.scale * mixed[1];
    return in_floats ? unit({mixed}) : VectorRange{mixed};
}

} // namespace

LightingTables make_lighting_tables(const Scene& scene, const ColorModel& model) {
    LightingTables tables;
    tables.scene = &scene;
    tables.model = model;
    tables.bumps.resize(scene.materials.size());
    tables.slopes.resize(scene.materials.size());
    tables.pyramids.resize(scene.materials.size());
    tables.decals.resize(scene.textures.size());
    // Only of materials that are drawn: an unused one may have bumps that the form cannot hold.
    for (const Mesh& mesh : scene.meshes) {
        const Material& material = scene.materials[mesh.material];
        std::optional<BumpTexels>& bumps = tables.bumps[mesh.material];
        if (filters(model) && material.decal != no_texture &&
            tables.decals[material.decal].levels.empty())
            tables.decals[material.decal] = expected_mipmap(scene.textures[material.decal].texels);
        if (material.bump == Bump::none || bumps || tables.pyramids[mesh.material]) continue;
        if (filters(model)) {
            tables.pyramids[mesh.material] = expected_pyramid(scene, material, model.filter);
            continue;
        }
        bumps = expected_bump_texels(scene, material, model.bump_form);
        if (material.bump == Bump::height_field)
            tables.slopes[mesh.material] =
                expected_slopes(scene.textures[material.bump_map], material.bump_scale);
    }
    assert(model.reflects == scene.environment.has_value());
    assert(!model.reflects || model.axes == ColorModel::Axes::world); // the environment's
    if (model.normalisation == Normalisation::cube_map)
        tables.cube = expected_normalisation_cube(model.cube_size);
    if (model.tangents == TangentSource::polygons)
        tables.polygon_surfaces = expected_polygon_surfaces(scene);
    return tables;
}

RangeOf<glm::dvec2> slope_range(const LightingTables& tables, const Material& material,
                                const PlaceRange& at) {
    const auto index = static_cast<std::size_t>(&material - tables.scene->materials.data());
    const Image<glm::dvec2>& slopes = tables.slopes[index];
    const TextureImage& map = tables.scene->textures[material.bump_map];
    // Half of what heights between 0 and 1 differ by.
    const Interval any = material.bump_scale * Interval{-0.5, 0.5};
    return mixed_range(
        turning_places(map.wrap_s, slopes.width, at[0]),
        turning_places(map.wrap_t, slopes.height, at[1]),
        [&](int x, int y) { return slopes.at(x, y); }, RangeOf<glm::dvec2>{any, any});
}

LightingInputs true_inputs(const LightingTables& tables, const InputPoint& point) {
    const Scene& scene = *tables.scene;
    const Shading& shading = point.shading;
    const Material& material = material_of(scene, point.triangle);
    const TangentFrame frame = centre_frame(shading);
    LightingInputs inputs;
    inputs.light = into(frame, {around(shading.to_light)});
    inputs.half = into(frame, {around(shading.half)});
    inputs.bump = into(frame, {around(shading.bumped)});
    // The frame holds no tangents if there is no bump map to need them.
    if (material.bump == Bump::none) inputs.bump = {around(glm::dvec3(0, 0, 1))};
    inputs.radiance = around(shading.light);
    inputs.decal = around(shading.decal);
    inputs.gloss = around(shading.gloss);
    inputs.reflection = around(shading.reflection_color);
    inputs.specular = material.specular;
    inputs.ambient = scene.ambient;
    inputs.highlight = scene.highlight;
    inputs.lit = shading.lit;
    return inputs;
}

namespace {

/// L and H in the tangent space of the seen side.
struct LightingVectors {
    VectorRange light;
    VectorRange half;
};

LightingVectors made_per_pixel(const LightingTables& tables, const ColorModel& model,
                               const Interpolated& at, const TangentFrame& world) {
    const glm::dmat3 axes = lighting_axes(*tables.scene, model);
    const TangentFrame frame = rotated(axes, world);
    const VectorRange light =
        normalised(tables, model, {around(axes * at.to_light), at.to_light_off});
    const VectorRange to_eye =
        normalised(tables, model, {around(-(axes * at.from_eye)), at.from_eye_off});
    VectorRange between = light + to_eye;
    between.box = widened(between.box, v);
    return {into(frame, light), into(frame, normalised(tables, model, between))};
}

/// Of a surface without bumps, which has no tangent space at its vertices, they are carried into
/// the pixel's.
LightingVectors made_at_vertices(const LightingTables& tables, const ColorModel& model,
                                 const InputPoint& point, std::span<const Surface, 3> corners,
                                 const TangentFrame& world) {
    const bool is_bumpy = material_of(*tables.scene, point.triangle).bump != Bump::none;
    const auto on_seen_side = [&](const VectorRange& interpolated) {
        VectorRange vector = normalised(tables, model, interpolated);
        if (!is_bumpy) return into(world, vector);
        for (Interval& component : vector.box) component = point.shading.side * component;
        return vector;
    };
    const VertexVectors made =
        vertex_vectors(point.scene, point.triangle, corners, model.vectors, point.spread);
    return {on_seen_side(made.light), on_seen_side(made.half)};
}

/// What a technique that filters reads in place of level 0.
void add_filtered(const LightingTables& tables, const ColorModel& model, const InputPoint& point,
                  const FootprintChoice& choice, LightingInputs& inputs) {
    const Scene& scene = *tables.scene;
    const Material& material = material_of(scene, point.triangle);
    const Interpolated& at = point.interpolated;
    inputs.bump = {around(glm::dvec3(0, 0, 1))};
    if (material.bump != Bump::none) {
        const auto index = static_cast<std::size_t>(&material - scene.materials.data());
        const TextureImage& map = scene.textures[material.bump_map];
        inputs.filtered = filtered_bumps(*tables.pyramids[index],
                                         {map, at.bump_at, at.bump_steps, choice.bump}, model);
        inputs.bump = inputs.filtered->normal;
    }
    inputs.bump.distance += perturbed_normal_roundings * v;
    if (material.decal == no_texture) {
        add_surroundings(inputs, point, decal_range(scene, material, at.decal_at));
        return;
    }
    const TextureImage& map = scene.textures[material.decal];
    add_surroundings(inputs, point,
                     filtered_decal(tables.decals[material.decal], material,
                                    {map, at.decal_at, at.decal_steps, choice.decal},
                                    model.anisotropy));
}

/// The technique's inputs, were its model this one, which may differ from the tables' in how
/// vectors are made.
LightingInputs claimed_by(const LightingTables& tables, const ColorModel& model,
                          const InputPoint& given, const FootprintChoice& choice = {}) {
    InputPoint point = given;
    std::span<const Surface, 3> corners = corners_of(given.scene.surfaces, point.triangle);
    if (model.tangents == TangentSource::polygons) {
        corners = corners_of(tables.polygon_surfaces, point.triangle);
        point.interpolated = interpolated_at(given.scene, point.triangle, corners, point.spread);
        point.interpolated.tangent_off += polygon_tangent_error;
    }
    const TangentFrame world = frame_range(point);
    const LightingVectors vectors = model.vectors == VectorOrigin::per_pixel
                                        ? made_per_pixel(tables, model, point.interpolated, world)
                                        : made_at_vertices(tables, model, point, corners, world);
    LightingInputs inputs;
    inputs.light = vectors.light;
    inputs.half = vectors.half;
    if (filters(model)) {
        add_filtered(tables, model, point, choice, inputs);
        return inputs;
    }
    inputs.bump = bump_range(tables, point, world);
    inputs.bump.distance += perturbed_normal_roundings * v;
    add_surroundings(inputs, point, world, model.reflects);
    return inputs;
}

} // namespace

InputPoint input_point(const Scene& scene, const Shading& shading, std::uint32_t triangle,
                       const PixelSpread& spread) {
    return {scene, shading, triangle, spread,
            interpolated_at(scene, triangle, corners_of(scene.surfaces, triangle), spread)};
}

std::vector<FootprintChoice> footprint_choices(const LightingTables& tables,
                                               const InputPoint& point) {
    if (!filters(tables.model)) return {{}};
    const Scene& scene = *tables.scene;
    const Material& material = material_of(scene, point.triangle);
    const auto count = [&](std::uint32_t texture, const PlaceSteps& steps) {
        if (texture == no_texture) return std::size_t{1};
        const Image<glm::vec4>& texels = scene.textures[texture].texels;
        const auto footprints =
            footprint_ranges(steps, {texels.width, texels.height}, tables.model.anisotropy);
        return std::max<std::size_t>(1, footprints.size());
    };
    const std::size_t bumps = count(material.bump_map, point.interpolated.bump_steps);
    const std::size_t decals = count(material.decal, point.interpolated.decal_steps);
    std::vector<FootprintChoice> choices;
    for (std::size_t bump = 0; bump < bumps; ++bump)
        for (std::size_t decal = 0; decal < decals; ++decal) choices.push_back({bump, decal});
    return choices;
}

LightingInputs claimed_inputs(const LightingTables& tables, const InputPoint& point,
                              const FootprintChoice& choice) {
    return claimed_by(tables, tables.model, point, choice);
}

SingleStepInputs single_step_inputs(const LightingTables& tables, const InputPoint& centre) {
    ColorModel plain = tables.model;
    plain.normalisation = Normalisation::exact;
    plain.vectors = VectorOrigin::per_pixel;
    plain.tangents = TangentSource::vertices;
    const auto with = [&](const auto& change) {
        ColorModel model = plain;
        change(model);
        return claimed_by(tables, model, centre);
    };
    return {.normalised =
                with([&](ColorModel& model) { model.normalisation = tables.model.normalisation; }),
            .at_vertices = with([&](ColorModel& model) { model.vectors = tables.model.vectors; }),
            .of_polygons =
                with([&](ColorModel& model) { model.tangents = tables.model.tangents; })};
}

} // namespace shadowproof
