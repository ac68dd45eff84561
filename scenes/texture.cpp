#include "scenes/texture.h"

#include <algorithm>
#include <cmath>

namespace shadowproof {

namespace {

/// std::floor, which is a call on processors that are not known to have an instruction for it. The
/// detour by an integer is exact below 2^62.
double floor_of(double x) {
    if (!(std::abs(x) < 0x1p62)) return std::floor(x);
    const auto toward_zero = static_cast<double>(static_cast<std::int64_t>(x));
    return toward_zero > x ? toward_zero - 1 : toward_zero;
}

/// A texel number between -1 and one behind the last period's end, brought into [0, n).
int mirrored(int texel, int n) {
    if (texel < 0) return -1 - texel;
    if (texel >= 2 * n) return texel - 2 * n;
    return texel < n ? texel : 2 * n - 1 - texel;
}

} // namespace

Taps taps_at(Wrap wrap, int texels, double at) {
    const double n = texels;
    if (wrap == Wrap::repeat) at -= floor_of(at);
    if (wrap == Wrap::mirrored_repeat) at -= 2 * floor_of(at / 2);
    double x = n * at - 0.5;
    if (wrap == Wrap::clamp_to_edge) x = std::clamp(x, 0.0, n - 1);
    const double below = floor_of(x);
    const int first = static_cast<int>(below);
    const double fraction = x - below;
    switch (wrap) {
    case Wrap::repeat:
        return {first < 0 ? texels - 1 : first, first + 1 == texels ? 0 : first + 1, fraction};
    case Wrap::mirrored_repeat:
        return {mirrored(first, texels), mirrored(first + 1, texels), fraction};
    case Wrap::clamp_to_edge:
        break;
    }
    return {first, std::min(first + 1, texels - 1), fraction};
}

} // namespace shadowproof
