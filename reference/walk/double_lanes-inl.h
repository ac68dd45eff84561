// Sixteen numbers, as many at once as vectors hold: loading, storing and masks, for the files that
// compute with doubles; compiled by each of them for each instruction set (see Highway's own -inl.h
// files for the guard).
#if defined(SHADOWPROOF_REFERENCE_DOUBLE_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SHADOWPROOF_REFERENCE_DOUBLE_LANES_INL
#undef SHADOWPROOF_REFERENCE_DOUBLE_LANES_INL
#else
#define SHADOWPROOF_REFERENCE_DOUBLE_LANES_INL
#endif

#include "reference/walk/box_tree.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace shadowproof::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Doubles = hn::CappedTag<double, packet_size>;
using Floats = hn::Rebind<float, Doubles>;
using Number = hn::Vec<Doubles>;

constexpr Doubles doubles;
constexpr Floats floats;

inline Number number(double x) {
    return hn::Set(doubles, x);
}

/// Those of the lanes from the i-th on, wherever they lie in memory.
inline Number load(const Lanes<double>& values, std::size_t i) {
    return hn::LoadU(doubles, values.data() + i);
}
inline Number load(const Lanes<float>& values, std::size_t i) {
    return hn::PromoteTo(doubles, hn::LoadU(floats, values.data() + i));
}
inline void store(Number value, Lanes<double>& to, std::size_t i) {
    hn::StoreU(value, doubles, to.data() + i);
}
inline void store(Number value, Lanes<float>& to, std::size_t i) {
    hn::StoreU(hn::DemoteTo(floats, value), floats, to.data() + i);
}

} // namespace shadowproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
