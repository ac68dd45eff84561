#include "compare/driver/lighting/lighting_arithmetic.h"

#include "scenes/driver.h"

#include <cassert>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

namespace shadowproof {

namespace {

constexpr double v = float_roundoff;

/// How values kept in 8 bits are rounded.
enum class Steps : std::uint8_t {
    none,    ///< not at all
    nearest, ///< to the nearest of 255 steps
    within,  ///< to anything, but no further than by the error that is given
};

/// Which of the technique's differences from the truth are applied.
struct Ways {
    Steps steps = Steps::none;
    /// Whose self-shadowing dims the highlight, where that is not as the scene has it.
    std::optional<HighlightShadow> highlight_shadow{};
    bool clamps_early = false;         ///< colours and registers before the last are clamped
    ByteErrors bytes = llvmpipe_bytes; ///< of the colour buffer

    HighlightShadow shadow(const LightingInputs& in) const {
        return highlight_shadow.value_or(in.highlight.shadow);
    }
};

/// `error`: how many steps a kept value may be off; half a step for the nearest.
Interval kept(const Interval& a, Steps steps, double error = 0.5) {
    // All steps within `error` of some number of the interval.
    switch (steps) {
    case Steps::none:
        return a;
    case Steps::nearest:
        return {std::ceil(255 * a.low - error) / 255, std::floor(255 * a.high + error) / 255};
    case Steps::within:
        break;
    }
    return widened(a, error / 255);
}

Interval cut(const Interval& a, const Ways& ways, double low, double high) {
    return ways.clamps_early ? clamped(a, low, high) : a;
}

Interval self_shadow(const Interval& z) {
    return clamped(8 * z, 0, 1);
}

/// Rounding of floats: a dozen products and sums on the way to a colour, of terms no larger than
/// their sum, any of which may be flushed to 0.
Interval rounded(const Interval& a) {
    return widened(a, 12 * (v * std::max(std::abs(a.low), std::abs(a.high)) + float_underflow));
}

struct Terms {
    Interval diffuse;
    Interval specular;
};

/// A vector's component along N.
Interval along_normal(const VectorRange& a) {
    return dot(a, {around(glm::dvec3(0, 0, 1))});
}

Terms terms_of(const LightingInputs& in, const Ways& ways) {
    const Interval light_shadow = self_shadow(along_normal(in.light));
    const Interval diffuse = light_shadow * not_negative(dot(in.light, in.bump));
    Interval specular = not_negative(dot(in.half, in.bump));
    for (int k = 0; k < in.highlight.squarings; ++k) specular = squared(specular);
    const HighlightShadow shadow = ways.shadow(in);
    if (by_half_angle(shadow)) specular = self_shadow(along_normal(in.half)) * specular;
    if (by_light(shadow)) specular = light_shadow * specular;
    return {rounded(diffuse), rounded(specular)};
}

Intervals in_floats(const LightingInputs& in, const Ways& ways) {
    const Terms terms = in.lit ? terms_of(in, ways) : Terms{};
    Intervals color;
    for (std::size_t k = 0; k < 3; ++k) {
        const int c = static_cast<int>(k);
        const Interval ambient = around(in.ambient[c]) * in.decal[k];
        const Interval diffuse = in.radiance[k] * terms.diffuse * in.decal[k];
        const Interval specular = in.specular[c] * in.radiance[k] * terms.specular * in.gloss;
        color[k] = rounded(ambient + diffuse + specular + in.reflection[k]);
    }
    return color;
}

/// What the passes of diffuse light and of highlights send to the frame buffer, by channel.
struct PassColors {
    Intervals diffuse; ///< with the ambient light
    Intervals highlight;
};

/// Three passes over a frame buffer of 8 bits (raster/techniques/bumps/bump_three_pass.cpp).
Intervals blended(const PassColors& passes, const LightingInputs& in, const Ways& ways) {
    const ByteErrors& bytes = ways.bytes;
    const auto stored = [&](const Interval& a, double error) {
        return kept(cut(a, ways, 0, 1), ways.steps, error);
    };
    const auto about_to_blend = [&](const Interval& a) {
        const bool any = !bytes.rounds_before_blending && ways.steps == Steps::nearest;
        const Interval sent = cut(a, ways, 0, 1);
        return kept(sent, any ? Steps::within : ways.steps, bytes.overwriting);
    };
    Intervals color;
    for (std::size_t k = 0; k < 3; ++k) {
        const Interval light = stored(passes.diffuse[k], bytes.overwriting);
        Interval sum = stored(light * about_to_blend(in.decal[k]), bytes.multiplying);
        if (in.lit) {
            sum = sum + about_to_blend(passes.highlight[k]);
            // Sums of two bytes are bytes, but for a float's rounding.
            sum = bytes.rounds_before_blending ? cut(widened(sum, bytes.adding / 255), ways, 0, 1)
                                               : stored(sum, bytes.adding);
        }
        color[k] = clamped(sum, 0, 1);
    }
    return color;
}

/// Floats within a pass.
Intervals in_float_passes(const LightingInputs& in, const Ways& ways) {
    const Terms terms = in.lit ? terms_of(in, ways) : Terms{};
    PassColors passes;
    for (std::size_t k = 0; k < 3; ++k) {
        const int c = static_cast<int>(k);
        passes.diffuse[k] = around(in.ambient[c]) + in.radiance[k] * terms.diffuse;
        passes.highlight[k] = rounded(in.specular[c] * in.radiance[k] * terms.specular * in.gloss);
    }
    return blended(passes, in, ways);
}

/// A register of the combiners: 8 bits and a sign. Its inputs were computed in floats.
Interval in_register(const Interval& a, const Ways& ways) {
    return cut(kept(rounded(a), ways.steps), ways, -1, 1);
}

/// A vector from a texture of bytes. The nearest bytes are known for boxes only.
VectorRange in_bytes(const VectorRange& vector, const Ways& ways) {
    const bool nearest = ways.steps == Steps::nearest;
    VectorRange bytes = vector;
    if (nearest) bytes = {box_around(vector)};
    for (Interval& component : bytes.box) {
        const Interval byte = kept(rounded(0.5 * (component + around(1))), ways.steps);
        component = 2 * cut(byte, ways, 0, 1) + around(-1);
    }
    return bytes;
}

/// A number in a texture's byte.
Interval in_byte(const Interval& a, const Ways& ways) {
    return kept(rounded(cut(a, ways, 0, 1)), ways.steps);
}

/// Passes of two general combiner stages and the final one each (raster/glsl/lighting/
/// two_stages.glsl).
Intervals in_two_stages(const LightingInputs& in, const Ways& ways) {
    const auto q = [&](const Interval& a) { return in_register(a, ways); };
    PassColors passes;
    if (!in.lit) {
        for (std::size_t k = 0; k < 3; ++k)
            passes.diffuse[k] = around(in.ambient[static_cast<int>(k)]);
        return blended(passes, in, ways);
    }
    const VectorRange bump = in_bytes(in.bump, ways);
    const VectorRange light = in_bytes(in.light, ways);
    const VectorRange half = in_bytes(in.half, ways);
    // 0, of both passes
    const auto shadow = [&](const VectorRange& a) { return clamped(q(8 * along_normal(a)), 0, 1); };
    const Interval l_bump = q(dot(light, bump));
    const Interval h_bump = q(dot(half, bump));
    // 1
    const Interval diffuse = q(not_negative(l_bump) * shadow(light));
    const Interval power2 = q(squared(not_negative(h_bump)));
    const HighlightShadow dims = ways.shadow(in);
    const Interval dimmed = (by_half_angle(dims) ? shadow(half) : around(1)) *
                            (by_light(dims) ? shadow(light) : around(1));
    // The final stage, and one product more
    const Interval power4 = q(squared(not_negative(power2)));
    const Interval power8 = q(squared(not_negative(power4)));
    const Interval gloss = in_byte(in.gloss, ways);
    for (std::size_t k = 0; k < 3; ++k) {
        const int c = static_cast<int>(k);
        passes.diffuse[k] =
            cut(q(diffuse * q(in.radiance[k]) + q(around(in.ambient[c]))), ways, 0, 1);
        const Interval color = q(q(in.specular[c] * in.radiance[k]) * dimmed);
        passes.highlight[k] = rounded(cut(q(color * not_negative(power8)), ways, 0, 1) * gloss);
    }
    return blended(passes, in, ways);
}

/// Four general combiner stages and the final one (raster/glsl/lighting/four_stages.glsl), after
/// Kilgard 2001.
Intervals in_four_stages(const LightingInputs& in, const Ways& ways) {
    const auto q = [&](const Interval& a) { return in_register(a, ways); };
    Intervals color;
    const Interval gloss = in_byte(in.gloss, ways);
    const VectorRange bump = in_bytes(in.bump, ways);
    const VectorRange light = in_bytes(in.light, ways);
    const VectorRange half = in_bytes(in.half, ways);
    // 0
    const Interval l_bump = q(dot(light, bump));
    const Interval h_bump = q(dot(half, bump));
    const auto shadow = [&](const Interval& z) { return clamped(q(8 * z), 0, 1); };
    const Interval light_shadow = shadow(along_normal(light));
    // 1
    const Interval diffuse = q(not_negative(l_bump) * light_shadow);
    const HighlightShadow dims = ways.shadow(in);
    const Interval dimmed = q((by_light(dims) ? light_shadow : around(1)) * gloss);
    const Interval power2 = q(squared(not_negative(h_bump)));
    // 2 and 3
    const Interval power4 = q(squared(not_negative(power2)));
    const Interval power8 = q(squared(not_negative(power4)));
    const Interval half_shadow = by_half_angle(dims) ? shadow(along_normal(half)) : around(1);
    const Interval highlight = q(half_shadow * not_negative(power8));
    for (std::size_t k = 0; k < 3; ++k) {
        const int c = static_cast<int>(k);
        const Interval decal = in_byte(in.decal[k], ways);
        if (!in.lit) {
            color[k] = clamped(
                kept(around(in.ambient[c]) * in.decal[k], ways.steps, ways.bytes.overwriting), 0,
                1);
            continue;
        }
        const Interval primary = q(decal * q(in.radiance[k]));
        const Interval ambient = q(q(around(in.ambient[c])) * decal);
        const Interval shine = q(q(in.specular[c] * in.radiance[k]) * not_negative(dimmed));
        const Interval lit = q(q(diffuse) * primary);
        const Interval sum = cut(lit + ambient, ways, 0, 1);
        color[k] = clamped(q(shine * highlight + sum), 0, 1);
    }
    return color;
}

[[maybe_unused]] bool reflects(const LightingInputs& in) {
    return std::ranges::any_of(in.reflection, [](const Interval& a) { return a.high > 0; });
}

Intervals color_of(ColorModel::Arithmetic arithmetic, const LightingInputs& in, const Ways& ways) {
    assert(arithmetic == ColorModel::Arithmetic::floating || !reflects(in));
    switch (arithmetic) {
    case ColorModel::Arithmetic::floating:
        break;
    case ColorModel::Arithmetic::three_passes:
        return in_float_passes(in, ways);
    case ColorModel::Arithmetic::two_stages:
        return in_two_stages(in, ways);
    case ColorModel::Arithmetic::four_stages:
        return in_four_stages(in, ways);
    }
    return in_floats(in, ways);
}

Ways ways_of(const ColorModel& model) {
    const ColorModel::Arithmetic arithmetic = model.arithmetic;
    if (arithmetic == ColorModel::Arithmetic::floating) return {};
    return {.steps = Steps::nearest,
            .highlight_shadow = arithmetic == ColorModel::Arithmetic::four_stages
                                    ? HighlightShadow::both
                                    : HighlightShadow::half_angle,
            .clamps_early = true,
            .bytes = model.bytes};
}

} // namespace

std::string_view name_of(ColorTerm term) {
    switch (term) {
    case ColorTerm::normalisation:
        return "normalisation";
    case ColorTerm::vertices:
        return "vertices";
    case ColorTerm::tangents:
        return "tangents";
    case ColorTerm::bump_form:
        return "bump_form";
    case ColorTerm::bump_length:
        return "bump_length";
    case ColorTerm::steps:
        return "steps";
    case ColorTerm::self_shadow:
        return "self_shadow";
    case ColorTerm::clamping:
        return "clamping";
    case ColorTerm::interpolation:
        break;
    }
    return "interpolation";
}

Intervals predicted_color(const ColorModel& model, const LightingInputs& claimed) {
    Intervals color = color_of(model.arithmetic, claimed, ways_of(model));
    for (Interval& channel : color) channel = widened(channel, v); // a claim is read as floats
    return color;
}

Intervals color_bound(const ColorModel& model, const LightingInputs& budgeted) {
    const bool floating = model.arithmetic == ColorModel::Arithmetic::floating;
    return color_of(model.arithmetic, budgeted,
                    {.steps = floating ? Steps::none : Steps::within, .bytes = model.bytes});
}

namespace {

/// Whether it draws heights over texels of their true sides: from slopes, in eye space.
bool knows_texel_sides(const ColorModel& model) {
    const BumpForm form = model.bump_form;
    return model.axes == ColorModel::Axes::eye &&
           (form == BumpForm::as_given || form == BumpForm::height_field ||
            form == BumpForm::derivatives);
}

/// Whether the form is the asset's own. Heights are made of no other.
bool is_given(BumpForm form) {
    return form == BumpForm::as_given || form == BumpForm::height_field;
}

} // namespace

bool is_off_by_nature(const ColorModel& model, const Scene& scene) {
    return !makes_vectors_as_truth(model) ||
           (has_heights_in_space(scene) && !knows_texel_sides(model));
}

bool is_exact(const ColorModel& model, const Scene& scene) {
    return model.arithmetic == ColorModel::Arithmetic::floating &&
           model.normalisation == Normalisation::exact && is_given(model.bump_form) &&
           !is_off_by_nature(model, scene);
}

ColorTerms weights_of(const ColorModel& model, const LightingInputs& truth,
                      const SingleStepInputs& single, const LightingInputs& claimed,
                      const LightingInputs& freed) {
    const ColorModel::Arithmetic arithmetic = model.arithmetic;
    const Ways own = ways_of(model);
    const glm::dvec3 right = middle(color_of(arithmetic, truth, {}));
    ColorTerms weights{};
    const auto weigh = [&](ColorTerm term, const LightingInputs& inputs, const Ways& ways) {
        const glm::dvec3 off = glm::abs(middle(color_of(arithmetic, inputs, ways)) - right);
        weights[static_cast<std::size_t>(term)] = std::max({off.x, off.y, off.z});
    };
    LightingInputs inputs = truth;
    const auto weigh_vectors = [&](ColorTerm term, const LightingInputs& of) {
        inputs.light = of.light;
        inputs.half = of.half;
        weigh(term, inputs, {});
    };
    weigh_vectors(ColorTerm::normalisation, single.normalised);
    weigh_vectors(ColorTerm::vertices, single.at_vertices);
    inputs.reflection = single.of_polygons.reflection;
    weigh_vectors(ColorTerm::tangents, single.of_polygons);
    const glm::dvec3 bump = middle(claimed.bump.box);
    const double length = glm::length(bump);
    inputs = truth;
    inputs.reflection = single.normalised.reflection;
    if (length > 0) inputs.bump = {around(bump / length)};
    weigh(ColorTerm::bump_form, inputs, {});
    inputs = truth;
    inputs.bump = {around(length * middle(truth.bump.box))};
    weigh(ColorTerm::bump_length, inputs, {});
    weigh(ColorTerm::steps, truth, {.steps = own.steps, .bytes = own.bytes});
    weigh(ColorTerm::self_shadow, truth, {.highlight_shadow = own.highlight_shadow});
    weigh(ColorTerm::clamping, truth, {.clamps_early = own.clamps_early});
    const Intervals centre = color_of(arithmetic, claimed, {});
    const Intervals around_it = color_of(arithmetic, freed, {});
    double& interpolation = weights[static_cast<std::size_t>(ColorTerm::interpolation)];
    for (std::size_t k = 0; k < 3; ++k)
        interpolation = std::max(
            {interpolation, centre[k].low - around_it[k].low, around_it[k].high - centre[k].high});
    return weights;
}

glm::dvec3 showable(const ColorModel& model, const glm::dvec3& color) {
    if (model.arithmetic == ColorModel::Arithmetic::floating) return color;
    return glm::clamp(color, 0.0, 1.0);
}

} // namespace shadowproof
