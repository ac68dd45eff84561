// The edges from which a triangle's plane is computed in double, and floats on either side of a
// double, for bounds.
#pragma once

#include "reference/exact/norms.h"
#include "reference/trace/faces.h"

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <limits>

namespace shadowproof {

/// A float less than `x`, and one greater than it.
inline float float_below(double x) {
    return std::nextafter(static_cast<float>(x), -std::numeric_limits<float>::infinity());
}
inline float float_above(double x) {
    return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity());
}

/// Two edges of a triangle that share a corner.
struct PlaneEdges {
    glm::dvec3 a, ab, ac;
    double product; ///< at least that of their lengths; bounds the normal's errors

    explicit PlaneEdges(const Corners& given) {
        const Corners t = from_short_edge(given);
        a = t.a;
        ab = t.b - t.a;
        ac = t.c - t.a;
        const double longer = std::max(largest(ab), largest(ac));
        const double shorter = std::min(largest(ab), largest(ac));
        product = (shorter < 0x1p-20 * longer ? shorter : longer) * longer;
    }
};

} // namespace shadowproof
