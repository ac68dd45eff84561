#include "scenes/load/common/nearest_name.h"

#include <algorithm>

namespace shadowproof {

namespace {

/// Edits from a to b, each pair of letters exchanged at most once (optimal string alignment).
std::size_t edits(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before;              // row i - 2
    std::vector<std::size_t> above(b.size() + 1); // row i - 1
    for (std::size_t k = 0; k <= b.size(); ++k) above[k] = k;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::vector<std::size_t> row(b.size() + 1, i);
        for (std::size_t k = 1; k <= b.size(); ++k) {
            const std::size_t replaced = above[k - 1] + (a[i - 1] == b[k - 1] ? 0 : 1);
            row[k] = std::min({above[k] + 1, row[k - 1] + 1, replaced});
            if (i > 1 && k > 1 && a[i - 1] == b[k - 2] && a[i - 2] == b[k - 1])
                row[k] = std::min(row[k], before[k - 2] + 1);
        }
        before = std::move(above);
        above = std::move(row);
    }
    return above.back();
}

} // namespace

std::string nearest_name(std::string_view word, const std::vector<std::string>& names) {
    std::string nearest;
    std::size_t fewest = word.size() / 3 + 1;
    if (word.size() > 100) return nearest;
    for (const std::string& name : names) {
        const std::size_t needed = edits(word, name);
        if (needed >= fewest) continue;
        fewest = needed;
        nearest = name;
    }
    return nearest;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& names) {
    const std::string name = nearest_name(word, names);
    return name.empty() ? "" : " (did you mean " + name + "?)";
}

} // namespace shadowproof
