// The bias of a shadow map, or of shadow rays, fitted to a picture.
#pragma once

#include "compare/picture/light_sampling.h"
#include "compare/picture/trial.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace shadowproof {

/// A setting that explains fewer pixels more is left out: chance explains as many.
inline constexpr std::int64_t least_gain = 4;

struct FittedBias {
    MapBias bias;
    std::int64_t score = 0; ///< pixels that agree with the picture, but for a constant
};

/// The constant by which most is explained less what is contradicted: half way between the pixels
/// that it must light and those that it must not. `like` says in which numbers, and with which
/// slope. `samples`: of the trial's sample. Nothing where no constant makes a difference.
std::optional<FittedBias> fitted_bias(const Trial& trial, const std::vector<LightSample>& samples,
                                      const MapBias& like);

/// The best of all numbers that are compared, and where some slope is better still, with that.
std::optional<FittedBias> fitted_bias(const Trial& trial, const std::vector<LightSample>& samples);

} // namespace shadowproof
