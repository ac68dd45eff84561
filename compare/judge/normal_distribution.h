// Sums of many roundings, as chances: they are taken to be normally distributed.
//
// N roundings, each of anything up to e, add up to N e at most, and to sqrt(N / 3) e by standard
// deviation; half of that, since the largest error that rounding to float may have, relative to a
// number, is twice the smallest.
#pragma once

#include <cmath>
#include <numbers>

namespace shadowproof {

/// The standard deviation of a rounding, over its bound.
inline const double deviation_of_rounding = 0.5 / std::sqrt(3.0);

/// Of a normal distribution with that standard deviation, the share that lies further than a
/// distance to one side of its middle. 0.5 where the deviation is no number: what is off may lie
/// anywhere.
inline double share_beyond(double distance, double deviation) {
    if (deviation == 0) return distance > 0 ? 0 : 0.5;
    const double beyond = 0.5 * std::erfc(distance / (deviation * std::numbers::sqrt2));
    return beyond >= 0 ? beyond : 0.5;
}

} // namespace shadowproof
