// Lighting by bump maps a second time, written out number by number from the definition in
// reference/shade/shading.h and sharing no code with it; with faults to choose from, as renderers
// have them.
#pragma once

#include "scenes/scene.h"

#include <glm/vec3.hpp>
#include <ostream>
#include <string>

namespace shadowproof::witness {

enum class Fault {
    none,
    flipped_hand,      ///< the bitangent points down
    exponent_9,        ///< specular to the ninth power
    no_self_shadow,    ///< both self-shadowing terms are 1
    srgb_normal_map,   ///< the normal map is decoded as if it held colours
    inverted_green,    ///< the normal map's y points down
    no_renormalise,    ///< neither interpolated normals nor sampled ones are normalised
    no_gloss,          ///< the decal's alpha is left out
    linear_decal,      ///< the decal's bytes are taken for linear light
    turned_reflection, ///< the eye ray's reflection is looked up in the opposite direction
    flat_reflection,   ///< reflected at the interpolated normal
};
inline constexpr Fault all_faults[]{
    Fault::flipped_hand,      Fault::exponent_9,     Fault::no_self_shadow, Fault::srgb_normal_map,
    Fault::inverted_green,    Fault::no_renormalise, Fault::no_gloss,       Fault::linear_decal,
    Fault::turned_reflection, Fault::flat_reflection};
std::string name_of(Fault fault);
inline std::ostream& operator<<(std::ostream& out, Fault fault) {
    return out << name_of(fault);
}

/// Linear colour where the eye ray along `direction` sees `triangle`.
glm::dvec3 color_at(const Scene& scene, const glm::dvec3& direction, std::uint32_t triangle,
                    bool lit, Fault fault = Fault::none);

} // namespace shadowproof::witness
