// libFuzzer's own mutations, for targets that bring theirs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* bytes, std::size_t size, std::size_t most);

namespace shadowproof::fuzz {

/// Into libFuzzer's array, where it fits; else the old input is mutated by bytes.
inline std::size_t hand_over(const std::vector<std::uint8_t>& mutated, std::uint8_t* bytes,
                             std::size_t size, std::size_t most) {
    if (mutated.empty() || mutated.size() > most) return LLVMFuzzerMutate(bytes, size, most);
    std::memcpy(bytes, mutated.data(), mutated.size());
    return mutated.size();
}

} // namespace shadowproof::fuzz
