// Numbers that programs stumble over, and small moves of ordinary ones.
#pragma once

#include "tests/dice.h"

#include <cmath>
#include <limits>

namespace shadowproof::fuzz {

/// A value near the ends of the type, near zero, tiny, huge, or no number at all.
template <class Real>
Real special(Dice& dice) {
    using Limits = std::numeric_limits<Real>;
    const Real values[] = {Real(0),
                           -Real(0),
                           Real(1),
                           Real(-1),
                           Real(0.5),
                           Real(2),
                           Limits::min(),
                           Limits::denorm_min(),
                           Limits::epsilon(),
                           Real(1e-20),
                           Real(1e-5),
                           Real(1e5),
                           Real(1e9),
                           Real(1e18),
                           Real(3.4e38),
                           Real(1e-38),
                           Real(16777217),
                           Limits::max(),
                           Limits::lowest(),
                           Limits::infinity(),
                           -Limits::infinity(),
                           Limits::quiet_NaN()};
    return dice.one_of(values);
}

/// A value close to `value`, or one that is simply related to it.
template <class Real>
Real moved(Real value, Dice& dice) {
    constexpr Real infinity = std::numeric_limits<Real>::infinity();
    switch (dice.below(12)) {
    case 0:
        return std::nextafter(value, infinity);
    case 1:
        return std::nextafter(value, -infinity);
    case 2:
        return -value;
    case 3:
        return std::ldexp(value, static_cast<int>(dice.below(9)) - 4);
    case 4:
        return std::ldexp(value, static_cast<int>(dice.below(dice.one_in(4) ? 121 : 13)) - 6);
    case 5:
        return std::round(value);
    case 6:
        return std::round(value * 4) / 4;
    case 7:
        return value + Real(1);
    case 8:
        return value * (Real(1) + Real(1e-5));
    case 9:
        return dice.one_in(2) ? special<Real>(dice) : Real(0.5);
    case 10:
        return Real(0);
    default:
        return value + (static_cast<Real>(dice.below(2001)) - 1000) / 500;
    }
}

} // namespace shadowproof::fuzz
