// Where a point is looked up in a shadow map, and the value that is compared there: exactly, and
// within bounds of the driver's errors.
#pragma once

#include "compare/maps/light_view.h"

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace shadowproof {

/// Where a point, given relative to the light, is looked up in the map.
struct Lookup {
    Texel texel;            ///< the one at the point's place
    glm::ivec2 first{0, 0}; ///< of the block that is averaged, if one is; it may lie beside the map
    double value = 0;       ///< what is compared: the point's distance or depth, world units
    double depth = 0;       ///< along the face's axis
    bool in_map = true;     ///< false behind a spot's camera
};
Lookup lookup(const LightView& light, const glm::dvec3& from_light);

/// The texel that is read for one of a block, which may lie beside the map.
Texel texel_of_block(const MapModel& model, const Texel& texel);

/// Whether the block lies on its face altogether.
inline bool lies_within(const MapModel& model, const Lookup& lookup) {
    const auto fits = [&](int first) { return first >= 0 && first + model.filter <= model.size; };
    return fits(lookup.first.x) && fits(lookup.first.y);
}

/// Calls visit(texel) for each texel that is read.
template <class Visit>
void visit_asked(const MapModel& model, const Lookup& lookup, const Visit& visit) {
    if (model.filter == 0) return visit(lookup.texel);
    const bool is_inside = lies_within(model, lookup);
    for (int y = 0; y < model.filter; ++y)
        for (int x = 0; x < model.filter; ++x) {
            const Texel texel{lookup.texel.face, lookup.first.x + x, lookup.first.y + y};
            visit(is_inside ? texel : texel_of_block(model, texel));
        }
}

/// Whether the block that is averaged reaches beyond its face of a cube.
bool crosses_edge(const MapModel& model, const Lookup& lookup);

/// Of the texels that the lookup `asked` reads, the nearest to `place`; its first one where that is
/// on another face.
Texel own_texel(const MapModel& model, const Lookup& asked, const Texel& place);

/// A point relative to the light, with bounds of its components' errors.
struct UncertainPoint {
    glm::dvec3 from_light{0, 0, 0};
    glm::dvec3 error{0, 0, 0};
};

/// A lookup that the sampler may make for a point, given the point's errors.
struct PossibleLookup {
    Lookup lookup;   ///< which texels are read; its value is not set
    double low = 0;  ///< the least that Lookup::value may be
    double high = 0; ///< and the most
};
/// The first of the possible lookups for which `holds` is true; none where it is for no lookup.
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

/// How many of the comparisons, MapModel::asked in number, say `lit`; without any rounding. Where
/// values are averaged, all or none. `model`: the view's, or as it might be asked otherwise.
int lit_comparisons(const LightView& light, const MapModel& model, const Lookup& lookup);

/// How many of them may say `lit`: at least, and at most.
struct LitRange {
    int least = 0;
    int most = 0;
    bool holds(int lit) const { return least <= lit && lit <= most; }
};
LitRange lit_range(const LightView& light, const PossibleLookup& possible);

} // namespace shadowproof
