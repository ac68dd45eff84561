// What a Tracer holds: the scene prepared for the queries of reference/.
#pragma once

#include "reference/embree.h"
#include "reference/predicates.h"
#include "reference/trace.h"
#include "reference/view.h"

#include <cstdint>
#include <vector>

namespace shadowproof {

struct Tracer::State {
    const Scene* scene = nullptr;
    int threads = 1;
    Predicates predicates;
    Hierarchy hierarchy;
    OriginView from_eye;
    OriginView from_light;
    std::vector<std::uint8_t> double_sided; ///< a flag a triangle
    glm::dvec3 eye{0, 0, 0};
    glm::dvec3 light{0, 0, 0};
    double build_milliseconds = 0;

    /// Whether eye and light lie strictly on the same side of the triangle.
    bool faces_light(std::uint32_t triangle) const {
        return from_eye.side[triangle] * from_light.side[triangle] > 0;
    }
};

} // namespace shadowproof
