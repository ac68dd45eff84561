// Sizes of vectors, as error bounds use them.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>

namespace shadowproof {

/// The largest component's size.
inline double largest(const glm::dvec3& w) {
    return std::max({std::abs(w.x), std::abs(w.y), std::abs(w.z)});
}

/// The sum of the components' sizes.
inline double sum_of(const glm::dvec3& w) {
    return std::abs(w.x) + std::abs(w.y) + std::abs(w.z);
}

} // namespace shadowproof
