#include "compare/memory.h"

#include "compare/classify.h"
#include "reference/ledger.h"
#include "scenes/error.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/sysinfo.h>

#include <algorithm>
#include <fstream>

namespace shadowproof {

namespace {

/// Bytes of one pixel in all of these pictures.
template <class... T>
constexpr std::size_t bytes_of(Image<T>... /*pictures*/) {
    return (sizeof(T) + ... + 0);
}

/// Of a target in OpenGL, which in software lies in the same memory: claim (R8), triangle (R32UI),
/// sum (R32F), and depth with stencil (D24_S8, the smaller of the two formats).
constexpr std::size_t target_bytes = 1 + 4 + 4 + 4;

std::size_t technique_bytes() {
    const Frame frame;
    const Comparison comparison;
    return bytes_of(frame.claim, frame.counter, frame.volumes, frame.depth, frame.triangle) +
           bytes_of(comparison.cause, comparison.ledger_miss, comparison.predicted);
}

/// Counters and shadow depths: volumes may be others than the casters'.
std::size_t prediction_bytes() {
    const ShadowDepths depths;
    return sizeof(std::int32_t) +
           bytes_of(depths.at_surface, depths.at_near, depths.at_far, depths.at_infinity);
}

double gigabytes(std::uint64_t bytes) {
    return static_cast<double>(bytes) / 1e9;
}

} // namespace

std::size_t truth_bytes() {
    const GroundTruth truth;
    return bytes_of(truth.visibility, truth.triangle, truth.depth, truth.exactness);
}

std::size_t comparison_bytes() {
    const ShadowDepths depths;
    return truth_bytes() +
           bytes_of(depths.at_surface, depths.at_near, depths.at_far, depths.at_infinity) +
           prediction_bytes() + technique_bytes() + target_bytes;
}

std::uint64_t memory_there_is() {
    std::uint64_t bytes = ~std::uint64_t{0};
    struct sysinfo machine {};
    if (sysinfo(&machine) == 0)
        bytes = (std::uint64_t{machine.totalram} + machine.totalswap) * machine.mem_unit;
    struct rlimit limit {};
    if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
        bytes = std::min<std::uint64_t>(bytes, limit.rlim_cur);
    // The file holds "max", which is no number, where the group has no limit.
    std::uint64_t group = 0;
    if (std::ifstream("/sys/fs/cgroup/memory.max") >> group) bytes = std::min(bytes, group);
    return bytes;
}

void refuse_too_large(int width, int height, std::size_t pixel_bytes, std::uint64_t there_is) {
    const std::uint64_t needed =
        static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) * pixel_bytes;
    if (needed <= there_is) return;
    throw Error(fmt::format("--size {}x{}", width, height),
                fmt::format("needs at least {:.1f} GB of memory ({} bytes a pixel), and there are "
                            "{:.1f} GB",
                            gigabytes(needed), pixel_bytes, gigabytes(there_is)),
                "try a smaller picture, or fewer techniques at once");
}

} // namespace shadowproof
