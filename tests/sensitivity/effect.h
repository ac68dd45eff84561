// What a fault changes in a frame.
#pragma once

#include "raster/technique.h"

#include <cstdint>
#include <string>

namespace shadowproof {

/// How far a faulty frame is from the right one.
struct Effect {
    std::uint64_t claims = 0;
    std::uint64_t evidence = 0; ///< counters, or texels of a map
    std::uint64_t surfaces = 0; ///< triangles or depths
    std::uint64_t rays = 0;     ///< pixels whose rays, or what they met, differ
    std::uint64_t shares = 0;   ///< of light, at pixels that are partly lit
    std::uint64_t colors = 0;
    double largest_color = 0; ///< of 255
    bool of_map = false;      ///< evidence is of a map
    bool figures = false;     ///< fragments, or the picture of the volumes

    bool any() const { return size() > 0 || figures; }
    std::uint64_t size() const {
        return 1000 * claims + evidence + surfaces + rays + shares + colors;
    }
};

Effect effect_of(const Frame& right, const Frame& faulty);

/// "12 claims, 30 counters, 0 surfaces, figures"
std::string words_of(const Effect& effect);

} // namespace shadowproof
