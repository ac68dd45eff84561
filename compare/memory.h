// A picture that cannot fit is refused before the work, not by the kernel in the middle of it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace shadowproof {

/// What is said where memory runs out all the same.
inline constexpr const char* out_of_memory = "there is not enough memory; try a smaller --size";

/// Bytes a pixel of the truth alone.
std::size_t truth_bytes();
/// Bytes a pixel of truth and shadow depths, and of the technique that is being drawn and judged.
std::size_t comparison_bytes();

/// Bytes that this process may have: of the machine, its control group (Linux cgroup 2) and its
/// own limit (RLIMIT_AS), the least.
std::uint64_t memory_there_is();

/// Throws Error with what is needed and what there is, where a picture of `pixel_bytes` a pixel
/// needs more than `there_is`.
void refuse_too_large(int width, int height, std::size_t pixel_bytes,
                      std::uint64_t there_is = memory_there_is());

} // namespace shadowproof
