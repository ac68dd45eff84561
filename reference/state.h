// What a Tracer holds: the scene prepared for the queries of reference/.
#pragma once

#include "reference/embree.h"
#include "reference/predicates.h"
#include "reference/trace.h"
#include "reference/view.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace shadowproof {

struct Tracer::State {
    const Scene* scene = nullptr;
    int threads = 1;
    Predicates predicates;
    Hierarchy hierarchy;
    OriginView from_eye;
    OriginView from_light;                  ///< what does not cast is on no side of it
    std::vector<std::int8_t> side_of_light; ///< as OriginView::side, also of what does not cast
    std::vector<std::uint8_t> double_sided; ///< a flag a triangle
    std::vector<std::uint8_t> receives;     ///< a flag a triangle
    glm::dvec3 eye{0, 0, 0};
    glm::dvec4 light{0, 0, 0, 1}; ///< homogeneous
    std::optional<Cone> cone;     ///< of a spot light
    double build_milliseconds = 0;

    /// Whether eye and light lie strictly on the same side of the triangle.
    bool faces_light(std::uint32_t triangle) const {
        return from_eye.side[triangle] * side_of_light[triangle] > 0;
    }
};

} // namespace shadowproof
