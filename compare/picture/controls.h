// Negative controls: small faults in the truth of a scene that a check of it should catch.
#pragma once

#include "compare/picture/predict.h"
#include "scenes/frame.h"

#include <cstdint>
#include <string>
#include <vector>

namespace shadowproof {

struct Control {
    std::string control; ///< "caster_missing", "light_moved", "bias", "range", "triangle_missing",
                         ///< "shadow_shifted"
    std::string words;   ///< "lamp casts no shadow"
    Predict predict;     ///< refers to the scene that it was made for
};

/// Each caster in turn casts no shadow; the light is moved sideways by 1, 2 and 5 % of its distance
/// to what is seen, or turned by as much; shadow rays or maps have a bias of 1 % of it, or end at
/// nine tenths of the way to the furthest shadow; one triangle that casts a shadow is lost; all
/// shadows are shifted by a pixel.
std::vector<Control> controls_of(const TracedScene& traced);

/// A picture with such a fault, as it would be read: light and shadow are distinguished where the
/// user's picture distinguishes them, and right except for the fault.
struct FaultyFrame {
    Frame frame;
    std::uint64_t changed = 0; ///< pixels that the fault changes
    std::uint64_t told =
        0; ///< of those, pixels at which the picture distinguishes light from shadow
};
FaultyFrame faulty_frame(const TracedScene& traced, const Frame& own, const Control& control);

} // namespace shadowproof
