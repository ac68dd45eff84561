// Sums of many roundings, as chances: they are taken to be normally distributed.
#pragma once

#include <cmath>
#include <numbers>

namespace shadowproof {

/// Of a normal distribution with that standard deviation, the share that lies further than a
/// distance to one side of its middle. 0.5 where the deviation is no number: what is off may lie
/// anywhere.
inline double share_beyond(double distance, double deviation) {
    if (deviation == 0) return distance > 0 ? 0 : 0.5;
    const double beyond = 0.5 * std::erfc(distance / (deviation * std::numbers::sqrt2));
    return beyond >= 0 ? beyond : 0.5;
}

} // namespace shadowproof
