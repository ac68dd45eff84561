// Norms of vectors, as error bounds use them.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>

namespace shadowproof {

/// The largest absolute value of a component.
inline double largest(const glm::dvec3& w) {
    return std::max({std::abs(w.x), std::abs(w.y), std::abs(w.z)});
}

/// The sum of the components' absolute values.
inline double sum_of(const glm::dvec3& w) {
    return std::abs(w.x) + std::abs(w.y) + std::abs(w.z);
}

} // namespace shadowproof
