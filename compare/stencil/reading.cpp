#include "compare/stencil/reading.h"

#include <algorithm>
#include <array>

namespace shadowproof {

void sort_out(std::vector<Reading>& readings) {
    const auto key = [](const Reading& r) {
        return std::array<std::int64_t, 9>{r.count,       r.ideal,    r.in_cone,
                                           r.by_rounding, r.by_depth, r.by_planes,
                                           r.off_ray,     r.by_near,  r.by_far};
    };
    std::sort(readings.begin(), readings.end(),
              [&](const Reading& a, const Reading& b) { return key(a) < key(b); });
    readings.erase(
        std::unique(readings.begin(), readings.end(),
                    [&](const Reading& a, const Reading& b) { return key(a) == key(b); }),
        readings.end());
}

} // namespace shadowproof
