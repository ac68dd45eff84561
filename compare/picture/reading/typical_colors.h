// What many pixels have in common: typical colours, and whether they are of two kinds.
#pragma once

#include "compare/picture/reading/mesh_light.h"
#include "compare/picture/surface_colors.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <utility>
#include <vector>

namespace shadowproof {

/// What a share of the values do not reach.
template <class T>
T quantile(std::vector<T> values, double share) {
    const auto at = values.begin() +
                    static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

template <class T>
T median(std::vector<T> values) {
    return quantile(std::move(values), 0.5);
}

std::optional<Typical> typical(const std::vector<glm::dvec3>& colors);

/// Pixels that face the light at about one angle.
using AngleGroup = std::vector<const Observed*>;
using AngleGroups = std::array<AngleGroup, angle_groups>;

template <class Keep>
std::vector<glm::dvec3> values_of(const AngleGroup& group, const Keep& keep) {
    std::vector<glm::dvec3> values;
    for (const Observed* pixel : group)
        if (keep(*pixel)) values.push_back(pixel->value);
    return values;
}

struct TwoGroups {
    AngleGroup dark;
    AngleGroup bright;
};

/// The two groups into which colours fall by their brightness (2-means); nothing where they are
/// one. Of colours that are spread evenly, the groups' means lie twice as far apart as the colours
/// of both lie from their medians; groups that are two lie twice as far again.
std::optional<TwoGroups> two_groups(const AngleGroup& all, double step);

} // namespace shadowproof
