#include "compare/driver/lighting/color_terms.h"

#include "compare/driver/lighting/color_ways.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

namespace shadowproof {

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
        return "interpolation";
    case ColorTerm::filtering:
        return "filtering";
    case ColorTerm::surroundings:
        break;
    }
    return "surroundings";
}

ColorTerms weights_of(const ColorModel& model, const ColorSteps& steps) {
    const auto& [truth, single, claimed, freed] = steps;
    const ColorModel::Arithmetic arithmetic = model.arithmetic;
    const Ways own = ways_of(model);
    const glm::dvec3 right = middle(color_of(arithmetic, truth, {}));
    ColorTerms weights{};
    const auto weigh = [&](ColorTerm term, AddedInputs inputs, const Ways& ways) {
        const glm::dvec3 off = glm::abs(middle(color_of(arithmetic, inputs, ways)) - right);
        weights[static_cast<std::size_t>(term)] = std::max({off.x, off.y, off.z});
    };
    /// `change`: of the truth's inputs under each light, given by its number.
    const auto weigh_changed = [&](ColorTerm term, const auto& change) {
        std::vector<LightingInputs> inputs(truth.begin(), truth.end());
        for (std::size_t light = 0; light < inputs.size(); ++light) change(inputs[light], light);
        weigh(term, inputs, {});
    };
    const auto with_vectors = [](LightingInputs& inputs, const LightingInputs& of) {
        inputs.light = of.light;
        inputs.half = of.half;
    };
    weigh_changed(ColorTerm::normalisation, [&](LightingInputs& inputs, std::size_t light) {
        with_vectors(inputs, single[light].normalised);
    });
    weigh_changed(ColorTerm::vertices, [&](LightingInputs& inputs, std::size_t light) {
        with_vectors(inputs, single[light].at_vertices);
    });
    weigh_changed(ColorTerm::tangents, [&](LightingInputs& inputs, std::size_t light) {
        with_vectors(inputs, single[light].of_polygons);
        inputs.reflection = single[light].of_polygons.reflection;
    });
    weigh_changed(ColorTerm::bump_form, [&](LightingInputs& inputs, std::size_t light) {
        const glm::dvec3 bump = middle(claimed[light].bump.box);
        const double length = glm::length(bump);
        inputs.reflection = single[light].normalised.reflection;
        if (length > 0) inputs.bump = {around(bump / length)};
    });
    weigh_changed(ColorTerm::bump_length, [&](LightingInputs& inputs, std::size_t light) {
        const double length = glm::length(middle(claimed[light].bump.box));
        inputs.bump = {around(length * middle(inputs.bump.box))};
    });
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

ColorTerms weights_of(const ColorModel& model, const ColorSteps& steps, const PixelColors& means) {
    ColorTerms weights = weights_of(model, steps);
    const auto weigh = [&](ColorTerm term, const glm::dvec3& a, const glm::dvec3& b) {
        const glm::dvec3 off = glm::abs(a - b);
        weights[static_cast<std::size_t>(term)] = std::max({off.x, off.y, off.z});
    };
    weights[static_cast<std::size_t>(ColorTerm::bump_form)] = 0;
    weights[static_cast<std::size_t>(ColorTerm::bump_length)] = 0;
    weigh(ColorTerm::filtering, middle(color_of(model.arithmetic, steps.claimed, {})), means.alike);
    weigh(ColorTerm::surroundings, means.alike, means.all);
    return weights;
}

} // namespace shadowproof
