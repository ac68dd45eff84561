#include "reference/walk/walk_lines.h"

// Highway compiles what follows once for each instruction set, then chooses when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reference/walk/walk_lines.cpp"
// The order matters.
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "reference/walk/walk_lines-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace shadowproof::HWY_NAMESPACE {
namespace {

void cut_to_scene(const WalkLines& lines, WalkRays& rays, Lanes<double>& start) {
    for (std::size_t i = 0; i < packet_size; i += hn::Lanes(doubles)) {
        const auto axis = [&](const Vectors& of, std::size_t k) { return load(of.axis[k], i); };
        const WalkLine line{{axis(lines.p, 0), axis(lines.p, 1), axis(lines.p, 2)},
                            {axis(lines.w, 0), axis(lines.w, 1), axis(lines.w, 2)},
                            load(lines.begin, i),
                            load(lines.end, i)};
        cut_lanes(line, false, rays, start, i);
    }
}

} // namespace
} // namespace shadowproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shadowproof {

namespace {
HWY_EXPORT(cut_to_scene);
} // namespace

void cut_to_scene(const WalkLines& lines, WalkRays& rays, Lanes<double>& start) {
    HWY_DYNAMIC_DISPATCH(cut_to_scene)(lines, rays, start);
}

} // namespace shadowproof
#endif
