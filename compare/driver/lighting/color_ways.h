// In which of its ways a technique's arithmetic is evaluated: its own, or the truth's in the same
// stages. For the files of this folder.
#pragma once

#include "compare/driver/lighting/lighting_inputs.h"
#include "scenes/byte_blending.h"
#include "scenes/lighting_settings.h"

#include <cstdint>
#include <optional>

namespace shadowproof {

/// How values kept in 8 bits are rounded.
enum class Steps : std::uint8_t {
    none,    ///< not at all
    nearest, ///< to the nearest of 255 steps
    within,  ///< to anything, but no further than by the error that is given
};

/// Which of the technique's differences from the truth are applied.
struct Ways {
    Steps steps = Steps::none;
    /// Whose self-shadowing dims the highlight, where that is not as the scene has it.
    std::optional<HighlightShadow> highlight_shadow{};
    bool clamps_early = false;         ///< colours and registers before the last are clamped
    ByteErrors bytes = llvmpipe_bytes; ///< of the colour buffer

    HighlightShadow shadow(const LightingInputs& in) const {
        return highlight_shadow.value_or(in.highlight.shadow);
    }
};

/// All that a model does differently from the truth.
Ways ways_of(const ColorModel& model);

/// The colour of a pixel under the lights that are added up, in these ways.
Intervals color_of(ColorModel::Arithmetic arithmetic, AddedInputs at, const Ways& ways);

} // namespace shadowproof
