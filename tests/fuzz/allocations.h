// How much an input makes the program allocate, where AddressSanitizer counts it; elsewhere nothing
// is counted.
#pragma once

#include <cstdint>

namespace shadowproof::fuzz {

/// Of all threads.
class PeakAllocation {
public:
    /// Counts from what is allocated now on. One at a time.
    PeakAllocation();
    ~PeakAllocation();
    PeakAllocation(const PeakAllocation&) = delete;
    PeakAllocation& operator=(const PeakAllocation&) = delete;

    /// The most bytes at once since then.
    std::uint64_t bytes() const;
};

} // namespace shadowproof::fuzz
