// All that is known of one pixel, as JSON of schema shadowproof/pixel/1: what `explain` writes and
// draws, and what the report's inspector shows.
#pragma once

#include "compare/color/color_check.h"
#include "compare/judge/account.h"
#include "compare/judge/pixel_record.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace shadowproof {

/// The result of one technique at the pixel.
struct TechniqueAtPixel {
    std::string name;
    std::string family;
    std::string error; ///< if not empty, it could not run and the rest is meaningless
    Visibility claim = Visibility::background;
    double share = 0; ///< of the light, where the claim is partly lit
    bool shows_surface = true;
    std::uint32_t shown = no_triangle;  ///< the triangle read back, where it shows surfaces
    std::uint8_t cause = no_difference; ///< Cause, or no_difference
    std::vector<Cause> also;            ///< further causes: see Comparison::also
    bool too_near = false;              ///< as PixelCause has it
    Account account;
    std::optional<ColorAccount> color; ///< where it lights bump maps
};

nlohmann::ordered_json to_json(const Scene& scene, const PixelRecord& record,
                               const std::vector<TechniqueAtPixel>& techniques);

} // namespace shadowproof
