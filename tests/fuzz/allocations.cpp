#include "tests/fuzz/allocations.h"

#if defined(__SANITIZE_ADDRESS__)
#define SHADOWPROOF_COUNTS_ALLOCATIONS 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SHADOWPROOF_COUNTS_ALLOCATIONS 1
#endif
#endif

#include <algorithm>
#include <atomic>
#include <cstddef>

#ifdef SHADOWPROOF_COUNTS_ALLOCATIONS
// As in sanitizer/allocator_interface.h, which Debian's g++ comes without.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*on_malloc)(const volatile void*,
                                                                           std::size_t),
                                                         void (*on_free)(const volatile void*));
extern "C" std::size_t __sanitizer_get_allocated_size(const volatile void* at);
#endif

namespace shadowproof::fuzz {

namespace {

// The hooks have no other place to write to. What was allocated before the counting began and is
// freed in it makes the sum negative.
std::atomic<bool> counting{false};
std::atomic<std::int64_t> allocated{0};
std::atomic<std::int64_t> most{0};

#ifdef SHADOWPROOF_COUNTS_ALLOCATIONS
void on_malloc(const volatile void* /*at*/, std::size_t bytes) {
    if (!counting) return;
    const std::int64_t now = allocated += static_cast<std::int64_t>(bytes);
    std::int64_t before = most;
    while (now > before && !most.compare_exchange_weak(before, now)) {
    }
}

void on_free(const volatile void* at) {
    if (counting && at != nullptr)
        allocated -= static_cast<std::int64_t>(__sanitizer_get_allocated_size(at));
}

const bool hooked = __sanitizer_install_malloc_and_free_hooks(on_malloc, on_free) != 0;
#else
const bool hooked = false;
#endif

} // namespace

PeakAllocation::PeakAllocation() {
    allocated = 0;
    most = 0;
    counting = hooked;
}

PeakAllocation::~PeakAllocation() {
    counting = false;
}

std::uint64_t PeakAllocation::bytes() const {
    return static_cast<std::uint64_t>(std::max<std::int64_t>(most, 0));
}

} // namespace shadowproof::fuzz
