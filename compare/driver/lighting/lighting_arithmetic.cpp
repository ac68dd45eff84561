#include "compare/driver/lighting/lighting_arithmetic.h"

#include "compare/driver/lighting/color_ways.h"
#include "compare/driver/lighting/filtered_highlight.h"
#include "scenes/driver.h"

#include <cassert>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

namespace shadowproof {

namespace {

constexpr double v = float_roundoff;

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
/// their sum; and, of each light but the first, its sum with those before. Any of the dozen may be
/// flushed to 0 under each light.
Interval rounded(const Interval& a, std::size_t lights = 1) {
    const auto each = static_cast<double>(lights);
    return widened(a, (11 + each) * v * std::max(std::abs(a.low), std::abs(a.high)) +
                          12 * each * float_underflow);
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
    Interval diffuse = light_shadow * not_negative(dot(in.light, in.bump));
    if (in.filtered && in.filtered->filter == BumpFilter::dimmed)
        diffuse = in.filtered->length * diffuse;
    Interval specular = highlight_range(in);
    const HighlightShadow shadow = ways.shadow(in);
    if (by_half_angle(shadow)) specular = self_shadow(along_normal(in.half)) * specular;
    if (by_light(shadow)) specular = light_shadow * specular;
    return {rounded(diffuse), rounded(specular)};
}

/// `at`: under each light in turn. Sums are of nothing negative, so that each is rounded by less
/// than their last.
Intervals in_floats(AddedInputs at, const Ways& ways) {
    Intervals color;
    for (std::size_t k = 0; k < 3; ++k) {
        const int c = static_cast<int>(k);
        const LightingInputs& any = at.front();
        color[k] = around(any.ambient[c]) * any.decal[k] + any.reflection[k];
    }
    for (const LightingInputs& in : at) {
        if (!in.lit) continue;
        const Terms terms = terms_of(in, ways);
        for (std::size_t k = 0; k < 3; ++k) {
            const Interval diffuse = in.radiance[k] * terms.diffuse * in.decal[k];
            const Interval specular =
                in.specular[static_cast<int>(k)] * in.radiance[k] * terms.specular * in.gloss;
            color[k] = color[k] + diffuse + specular;
        }
    }
    for (Interval& channel : color) channel = rounded(channel, at.size());
    return color;
}

/// A colour buffer of 8 bits per channel, and what it does to a number that is sent to it.
class ByteBuffer {
public:
    explicit ByteBuffer(const Ways& ways) : ways_(ways) {}

    Interval overwritten(const Interval& by) const { return stored(by, ways_.bytes.overwriting); }
    Interval multiplied(const Interval& held, const Interval& by) const {
        return stored(held * about_to_blend(by), ways_.bytes.multiplying);
    }
    /// Sums of two bytes are bytes, but for a float's rounding.
    Interval added(const Interval& held, const Interval& more) const {
        const Interval sum = held + about_to_blend(more);
        return ways_.bytes.rounds_before_blending
                   ? cut(widened(sum, ways_.bytes.adding / 255), ways_, 0, 1)
                   : stored(sum, ways_.bytes.adding);
    }

private:
    const Ways& ways_;

    Interval stored(const Interval& a, double error) const {
        return kept(cut(a, ways_, 0, 1), ways_.steps, error);
    }
    Interval about_to_blend(const Interval& a) const {
        const bool any = !ways_.bytes.rounds_before_blending && ways_.steps == Steps::nearest;
        const Interval sent = cut(a, ways_, 0, 1);
        return kept(sent, any ? Steps::within : ways_.steps, ways_.bytes.overwriting);
    }
};

/// What the passes of diffuse light and of highlights send to the colour buffer under one light, by
/// channel.
struct PassColors {
    Intervals diffuse; ///< with the ambient light, under the first
    Intervals highlight;
};

/// Passes over a colour buffer of 8 bits (raster/techniques/bumps/bump_three_pass.cpp): ambient and
/// diffuse light, of each light in turn, then the decal, then the highlights of each.
Intervals blended(std::span<const PassColors> passes, AddedInputs at, const Ways& ways) {
    const ByteBuffer buffer(ways);
    Intervals color;
    for (std::size_t k = 0; k < 3; ++k) {
        const LightingInputs& any = at.front();
        Interval held = buffer.overwritten(any.lit ? passes.front().diffuse[k]
                                                   : around(any.ambient[static_cast<int>(k)]));
        for (std::size_t i = 1; i < at.size(); ++i)
            if (at[i].lit) held = buffer.added(held, passes[i].diffuse[k]);
        held = buffer.multiplied(held, any.decal[k]);
        for (std::size_t i = 0; i < at.size(); ++i)
            if (at[i].lit) held = buffer.added(held, passes[i].highlight[k]);
        color[k] = clamped(held, 0, 1);
    }
    return color;
}

/// Ambient light, which is added once: with the first light.
glm::dvec3 ambient_of(AddedInputs at, std::size_t light) {
    return light == 0 ? at[light].ambient : glm::dvec3(0);
}

/// Floats within a pass.
Intervals in_float_passes(AddedInputs at, const Ways& ways) {
    std::vector<PassColors> passes(at.size());
    for (std::size_t i = 0; i < at.size(); ++i) {
        const LightingInputs& in = at[i];
        if (!in.lit) continue;
        const Terms terms = terms_of(in, ways);
        for (std::size_t k = 0; k < 3; ++k) {
            const int c = static_cast<int>(k);
            passes[i].diffuse[k] = around(ambient_of(at, i)[c]) + in.radiance[k] * terms.diffuse;
            passes[i].highlight[k] =
                rounded(in.specular[c] * in.radiance[k] * terms.specular * in.gloss);
        }
    }
    return blended(passes, at, ways);
}

/// A register of the combiners: 8 bits and a sign. Its inputs were computed in floats. Of 0 it
/// loses nothing.
Interval in_register(const Interval& a, const Ways& ways) {
    if (a.low == 0 && a.high == 0) return a;
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
/// two_stages.glsl), under a light that is seen.
PassColors two_stages(const LightingInputs& in, const glm::dvec3& ambient, const Ways& ways) {
    const auto q = [&](const Interval& a) { return in_register(a, ways); };
    PassColors passes;
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
        passes.diffuse[k] = cut(q(diffuse * q(in.radiance[k]) + q(around(ambient[c]))), ways, 0, 1);
        const Interval color = q(q(in.specular[c] * in.radiance[k]) * dimmed);
        passes.highlight[k] = rounded(cut(q(color * not_negative(power8)), ways, 0, 1) * gloss);
    }
    return passes;
}

Intervals in_two_stages(AddedInputs at, const Ways& ways) {
    std::vector<PassColors> passes(at.size());
    for (std::size_t i = 0; i < at.size(); ++i)
        if (at[i].lit) passes[i] = two_stages(at[i], ambient_of(at, i), ways);
    return blended(passes, at, ways);
}

/// Four general combiner stages and the final one (raster/glsl/lighting/four_stages.glsl), after
/// Kilgard 2001, under a light that is seen.
Intervals four_stages(const LightingInputs& in, const glm::dvec3& ambient_light, const Ways& ways) {
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
        const Interval primary = q(decal * q(in.radiance[k]));
        const Interval ambient = q(q(around(ambient_light[c])) * decal);
        const Interval shine = q(q(in.specular[c] * in.radiance[k]) * not_negative(dimmed));
        const Interval lit = q(q(diffuse) * primary);
        const Interval sum = cut(lit + ambient, ways, 0, 1);
        color[k] = clamped(q(shine * highlight + sum), 0, 1);
    }
    return color;
}

/// Whether no light may arrive, as outside a spot's cone; and whether some may.
bool may_be_dark(const LightingInputs& in) {
    return std::ranges::all_of(in.radiance, [](const Interval& a) { return a.low <= 0; });
}
bool may_be_lit(const LightingInputs& in) {
    return std::ranges::any_of(in.radiance, [](const Interval& a) { return a.high > 0; });
}

/// Ambient light times the decal, over it all of the first light with both, and the others added.
/// Where no light arrives the pass draws nothing. At the very edge of a cone floats decide that,
/// and whether the claim is `lit`: there the pixel may hold either.
Intervals in_four_stages(AddedInputs at, const Ways& ways) {
    const ByteBuffer buffer(ways);
    const LightingInputs& first = at.front();
    Intervals unlit;
    for (std::size_t k = 0; k < 3; ++k)
        unlit[k] = buffer.overwritten(around(first.ambient[static_cast<int>(k)]) * first.decal[k]);
    const bool at_edge = may_be_dark(first) && may_be_lit(first);
    Intervals color = unlit;
    if (at_edge || (first.lit && may_be_lit(first))) {
        color = four_stages(first, first.ambient, ways); // registers hold what the buffer holds
        if (at_edge) color = hull(color, unlit);
    }
    for (std::size_t i = 1; i < at.size(); ++i) {
        if (!at[i].lit) continue;
        const Intervals more = four_stages(at[i], glm::dvec3(0), ways);
        for (std::size_t k = 0; k < 3; ++k) color[k] = buffer.added(color[k], more[k]);
    }
    for (Interval& channel : color) channel = clamped(channel, 0, 1);
    return color;
}

[[maybe_unused]] bool reflects(const LightingInputs& in) {
    return std::ranges::any_of(in.reflection, [](const Interval& a) { return a.high > 0; });
}

} // namespace

Intervals color_of(ColorModel::Arithmetic arithmetic, AddedInputs at, const Ways& ways) {
    assert(!at.empty());
    assert(arithmetic == ColorModel::Arithmetic::floating || !reflects(at.front()));
    switch (arithmetic) {
    case ColorModel::Arithmetic::floating:
        break;
    case ColorModel::Arithmetic::three_passes:
        return in_float_passes(at, ways);
    case ColorModel::Arithmetic::two_stages:
        return in_two_stages(at, ways);
    case ColorModel::Arithmetic::four_stages:
        return in_four_stages(at, ways);
    }
    return in_floats(at, ways);
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

Intervals predicted_color(const ColorModel& model, AddedInputs claimed) {
    Intervals color = color_of(model.arithmetic, claimed, ways_of(model));
    for (Interval& channel : color) channel = widened(channel, v); // a claim is read as floats
    return color;
}

Intervals color_bound(const ColorModel& model, AddedInputs budgeted) {
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
    return filters(model) || !makes_vectors_as_truth(model) ||
           (has_heights_in_space(scene) && !knows_texel_sides(model));
}

bool is_exact(const ColorModel& model, const Scene& scene) {
    return model.arithmetic == ColorModel::Arithmetic::floating &&
           model.normalisation == Normalisation::exact && is_given(model.bump_form) &&
           !is_off_by_nature(model, scene);
}

glm::dvec3 showable(const ColorModel& model, const glm::dvec3& color) {
    if (model.arithmetic == ColorModel::Arithmetic::floating) return color;
    return glm::clamp(color, 0.0, 1.0);
}

} // namespace shadowproof
