// Disjoint sets of numbers that are united one pair at a time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace shadowproof {

/// Numbers 0 to count - 1, each a set of its own at first. Paths are halved on the way to the root.
class UnionFind {
public:
    explicit UnionFind(std::size_t count) : parents_(count) {
        std::iota(parents_.begin(), parents_.end(), 0U);
    }

    /// The smallest number of the set that `item` is in.
    std::uint32_t find(std::uint32_t item) {
        while (parents_[item] != item) item = parents_[item] = parents_[parents_[item]];
        return item;
    }

    void unite(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        parents_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<std::uint32_t> parents_; ///< a root is its own parent, and smaller than all others
};

} // namespace shadowproof
