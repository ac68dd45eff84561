// How time grows with the size of a problem: the exponent p of a power law, time = c * size^p.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace shadowproof {

/// One size and the median's interval there.
struct GrowthPoint {
    double size = 0;
    std::vector<double> samples{}; ///< milliseconds
};

/// An exponent with the ends of its 95 % interval.
struct Exponent {
    double value = 0;
    double low = 0;
    double high = 0;
};

/// Where one power law does not fit: the size from which on another one holds.
struct GrowthBreak {
    double size = 0;
    Exponent below{};
    Exponent above{};
};

struct Growth {
    std::string axis{}; ///< "pixels", "triangles"
    std::string scene{};
    std::string technique{};
    std::string family{}; ///< empty where it is not known
    std::string command{};
    std::vector<GrowthPoint> points{}; ///< by size
};

/// Least squares through the logarithms of sizes and median times; the interval by Student's t
/// (Draper and Smith 1998, section 1.4). None for fewer than three sizes that differ: two points
/// have no residual to tell an interval by.
std::optional<Exponent> exponent_of(const std::vector<GrowthPoint>& points);

/// The size at which two power laws, each through at least three sizes and sharing that one, leave
/// the least residual; none unless the intervals of their exponents lie apart.
std::optional<GrowthBreak> break_of(const std::vector<GrowthPoint>& points);

} // namespace shadowproof
