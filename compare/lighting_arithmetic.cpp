#include "compare/lighting_arithmetic.h"

#include "scenes/byte_blending.h"

#include <cassert>
#include <glm/common.hpp>

namespace shadowproof {

namespace {

constexpr double v = 0x1p-24; ///< rounding unit of float

/// How what is kept in 8 bits is rounded.
enum class Steps : std::uint8_t {
    none,        ///< not at all
    nearest,     ///< to the nearest of 255 steps
    within_half, ///< to anything that is no further away
};

/// What of a technique's ways is taken.
struct Ways {
    Steps steps = Steps::none;
    bool light_dims_highlight = false; ///< selfShadow(L) times the highlight
    bool clamps_early = false;         ///< colours and registers before the last
};

/// `error`: by how many steps what is kept may be off, half a one for the nearest.
Interval kept(const Interval& a, Steps steps, double error = 0.5) {
    // What is within `error` of a number: the steps on which both ends may come to lie.
    switch (steps) {
    case Steps::none:
        return a;
    case Steps::nearest:
        return {std::ceil(255 * a.low - error) / 255, std::floor(255 * a.high + error) / 255};
    case Steps::within_half:
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

/// Floats, each product and sum of which rounds: a dozen of them on the way to a colour, of terms
/// of their sum's size.
Interval rounded(const Interval& a) {
    return widened(a, 12 * v * std::max(std::abs(a.low), std::abs(a.high)));
}

struct Terms {
    Interval diffuse;
    Interval specular;
};

Terms terms_of(const LightingInputs& in, const Ways& ways) {
    const Interval diffuse = self_shadow(in.light[2]) * not_negative(dot(in.light, in.bump));
    const Interval power = squared(squared(squared(not_negative(dot(in.half, in.bump)))));
    Interval specular = self_shadow(in.half[2]) * power;
    if (ways.light_dims_highlight) specular = self_shadow(in.light[2]) * specular;
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

/// Three passes over a frame buffer of 8 bits (raster/techniques/bump_three_pass.cpp).
Intervals in_passes(const LightingInputs& in, const Ways& ways) {
    const Terms terms = in.lit ? terms_of(in, ways) : Terms{};
    const auto stored = [&](const Interval& a, double error = overwriting_error) {
        return kept(cut(a, ways, 0, 1), ways.steps, error);
    };
    Intervals color;
    for (std::size_t k = 0; k < 3; ++k) {
        const int c = static_cast<int>(k);
        const Interval light = stored(around(in.ambient[c]) + in.radiance[k] * terms.diffuse);
        Interval sum = stored(light * stored(in.decal[k]), multiplying_error);
        // Sums of two bytes are bytes; a float's rounding may put them beside.
        if (in.lit)
            sum = cut(widened(sum + stored(rounded(in.specular[c] * in.radiance[k] *
                                                   terms.specular * in.gloss)),
                              adding_error / 255),
                      ways, 0, 1);
        color[k] = clamped(sum, 0, 1);
    }
    return color;
}

/// A register of the combiners: 8 bits and a sign. What goes into it was computed in floats.
Interval in_register(const Interval& a, const Ways& ways) {
    return cut(kept(rounded(a), ways.steps), ways, -1, 1);
}

/// A vector that comes from a texture of bytes.
Intervals in_bytes(const Intervals& vector, const Ways& ways) {
    Intervals bytes;
    for (std::size_t k = 0; k < 3; ++k) {
        const Interval byte = kept(rounded(0.5 * (vector[k] + around(1))), ways.steps);
        bytes[k] = 2 * cut(byte, ways, 0, 1) + around(-1);
    }
    return bytes;
}

/// Four general combiner stages and the final one (raster/glsl/combiners.glsl), after Kilgard 2001.
Intervals in_combiners(const LightingInputs& in, const Ways& ways) {
    const auto q = [&](const Interval& a) { return in_register(a, ways); };
    const auto byte = [&](const Interval& a) {
        return kept(rounded(cut(a, ways, 0, 1)), ways.steps);
    };
    Intervals color;
    const Interval gloss = byte(in.gloss);
    const Intervals bump = in_bytes(in.bump, ways);
    const Intervals light = in_bytes(in.light, ways);
    const Intervals half = in_bytes(in.half, ways);
    // 0
    const Interval l_bump = q(dot(light, bump));
    const Interval h_bump = q(dot(half, bump));
    const auto shadow = [&](const Interval& z) { return clamped(q(8 * z), 0, 1); };
    const Interval light_shadow = shadow(light[2]);
    // 1
    const Interval diffuse = q(not_negative(l_bump) * light_shadow);
    const Interval dimmed = q((ways.light_dims_highlight ? light_shadow : around(1)) * gloss);
    const Interval power2 = q(squared(not_negative(h_bump)));
    // 2 and 3
    const Interval power4 = q(squared(not_negative(power2)));
    const Interval power8 = q(squared(not_negative(power4)));
    const Interval half_shadow = shadow(half[2]);
    const Interval highlight = q(half_shadow * not_negative(power8));
    for (std::size_t k = 0; k < 3; ++k) {
        const int c = static_cast<int>(k);
        const Interval decal = byte(in.decal[k]);
        if (!in.lit) {
            color[k] = clamped(
                kept(around(in.ambient[c]) * in.decal[k], ways.steps, overwriting_error), 0, 1);
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
        return in_passes(in, ways);
    case ColorModel::Arithmetic::combiners:
        return in_combiners(in, ways);
    }
    return in_floats(in, ways);
}

Ways ways_of(ColorModel::Arithmetic arithmetic) {
    if (arithmetic == ColorModel::Arithmetic::floating) return {};
    return {.steps = Steps::nearest,
            .light_dims_highlight = arithmetic == ColorModel::Arithmetic::combiners,
            .clamps_early = true};
}

} // namespace

std::string_view name_of(ColorTerm term) {
    switch (term) {
    case ColorTerm::normalisation:
        return "normalisation";
    case ColorTerm::bump_form:
        return "bump_form";
    case ColorTerm::steps:
        return "steps";
    case ColorTerm::self_shadow:
        return "self_shadow";
    case ColorTerm::clamping:
        break;
    }
    return "clamping";
}

Intervals foreseen_color(const ColorModel& model, const LightingInputs& claimed) {
    Intervals color = color_of(model.arithmetic, claimed, ways_of(model.arithmetic));
    for (Interval& channel : color) channel = widened(channel, v); // a claim is read as floats
    return color;
}

Intervals color_bound(const ColorModel& model, const LightingInputs& truth,
                      const LightingInputs& claimed) {
    LightingInputs between = claimed;
    between.light = hull(truth.light, claimed.light);
    between.half = hull(truth.half, claimed.half);
    between.bump = hull(truth.bump, claimed.bump);
    between.radiance = hull(truth.radiance, claimed.radiance);
    between.decal = hull(truth.decal, claimed.decal);
    between.gloss = hull(truth.gloss, claimed.gloss);
    between.reflection = hull(truth.reflection, claimed.reflection);
    const bool floating = model.arithmetic == ColorModel::Arithmetic::floating;
    return color_of(model.arithmetic, between,
                    {.steps = floating ? Steps::none : Steps::within_half});
}

double weight_of(ColorTerm term, const ColorModel& model, const LightingInputs& truth,
                 const LightingInputs& claimed) {
    LightingInputs inputs = truth;
    Ways ways;
    const Ways own = ways_of(model.arithmetic);
    switch (term) {
    case ColorTerm::normalisation:
        inputs.light = claimed.light;
        inputs.half = claimed.half;
        break;
    case ColorTerm::bump_form:
        inputs.bump = claimed.bump;
        inputs.reflection = claimed.reflection;
        break;
    case ColorTerm::steps:
        ways.steps = own.steps;
        break;
    case ColorTerm::self_shadow:
        ways.light_dims_highlight = own.light_dims_highlight;
        break;
    case ColorTerm::clamping:
        ways.clamps_early = own.clamps_early;
        break;
    }
    const glm::dvec3 moved = middle(color_of(model.arithmetic, inputs, ways)) -
                             middle(color_of(model.arithmetic, truth, {}));
    return std::max({std::abs(moved.x), std::abs(moved.y), std::abs(moved.z)});
}

glm::dvec3 showable(const ColorModel& model, const glm::dvec3& color) {
    if (model.arithmetic == ColorModel::Arithmetic::floating) return color;
    return glm::clamp(color, 0.0, 1.0);
}

} // namespace shadowproof
