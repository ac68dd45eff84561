#include "compare/stencil/counterfactual.h"

#include <cassert>

namespace shadowproof {

namespace {

/// Sets of `lifted` and `more` others from `first` on, in the order of the list.
std::optional<Limitations> try_sets(const std::vector<Limitation>& list, std::size_t first,
                                    Limitations lifted, int more,
                                    const std::function<bool(Limitations)>& mends) {
    if (more == 0) return mends(lifted) ? std::optional(lifted) : std::nullopt;
    for (std::size_t i = first; i < list.size(); ++i)
        if (auto found = try_sets(list, i + 1, lifted | list[i], more - 1, mends)) return found;
    return std::nullopt;
}

} // namespace

std::optional<Limitations> needed_lifts(Limitations has,
                                        const std::function<bool(Limitations)>& mends) {
    const std::vector<Limitation> list = listed(has);
    for (int size = 1; size <= has.size(); ++size)
        if (auto found = try_sets(list, 0, {}, size, mends)) return found;
    return std::nullopt;
}

Cause decisive_cause(Limitations needed) {
    assert(!needed.empty());
    return cause_of(listed(needed).front());
}

} // namespace shadowproof
