// Finds equal items by their hashes.
#pragma once

#include <bit>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

namespace shadowproof {

/// Spreads all bits over all others (the finalizer of MurmurHash3).
constexpr std::uint64_t mixed(std::uint64_t bits) {
    bits = (bits ^ bits >> 33U) * 0xff51afd7ed558ccdU;
    bits = (bits ^ bits >> 33U) * 0xc4ceb9fe1a85ec53U;
    return bits ^ bits >> 33U;
}

/// Equal where vectors are (-0 equals 0).
inline std::uint64_t hash_of(const glm::dvec3& v) {
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis)
        hash = mixed(hash + std::bit_cast<std::uint64_t>(v[axis] + 0.0));
    return hash;
}

/// For each item, the index of the first item that is equal to it. Equal items must have equal
/// hashes; where two hashes are equal, `same(i, k)` decides. It is called at most `patience` times
/// per item, after which equal items may be missed. O(n) time where most hashes differ.
template <class Same>
std::vector<std::uint32_t> first_of_same(std::span<const std::uint64_t> hashes, const Same& same,
                                         int patience = std::numeric_limits<int>::max()) {
    constexpr std::uint32_t none = 0xffffffffU;
    std::vector<std::uint32_t> table(std::bit_ceil(2 * hashes.size() + 1), none);
    std::vector<std::uint32_t> first(hashes.size());
    for (std::uint32_t i = 0; i < hashes.size(); ++i) {
        first[i] = i;
        int asked = 0;
        for (std::size_t slot = hashes[i];; ++slot) {
            std::uint32_t& found = table[slot & (table.size() - 1)];
            if (found == none) found = i;
            if (found == i) break;
            if (hashes[found] != hashes[i]) continue;
            if (asked == patience) break;
            ++asked;
            if (!same(found, i)) continue;
            first[i] = found;
            break;
        }
    }
    return first;
}

} // namespace shadowproof
