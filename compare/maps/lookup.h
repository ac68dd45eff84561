// Which texels of a shadow map a point asks, and what it is compared with: exactly, and within what
// a driver may make of it.
#pragma once

#include "compare/maps/light_view.h"

#include <functional>
#include <glm/vec3.hpp>
#include <optional>

namespace shadowproof {

/// What a point asks. Given relative to the light.
struct Lookup {
    Texel texel;
    double value = 0;   ///< the point's own: distance or depth, world units
    double depth = 0;   ///< along the face's axis
    bool in_map = true; ///< false behind a spot's camera or beside its square
};
Lookup lookup(const LightView& light, const glm::dvec3& from_light);

/// A point relative to the light, with bounds of its components' errors.
struct UncertainPoint {
    glm::dvec3 from_light{0, 0, 0};
    glm::dvec3 error{0, 0, 0};
};

/// A texel that may be asked, and bounds of the point's own value.
struct PossibleLookup {
    Texel texel;
    double low = 0; ///< of the value
    double high = 0;
};
/// The first of all texels that may be asked for which `holds`.
std::optional<PossibleLookup>
find_possible_lookup(const LightView& light, const UncertainPoint& point,
                     const std::function<bool(const PossibleLookup&)>& holds);

/// Whether a comparison with the texel's stored value may say `shadowed`, and may say `lit`.
struct Answers {
    bool shadowed = false;
    bool lit = false;
};
Answers compare(const MapModel& model, double stored, double low, double high);

/// The comparison without any rounding.
bool is_shadowed(const MapModel& model, double stored, double value);

} // namespace shadowproof
