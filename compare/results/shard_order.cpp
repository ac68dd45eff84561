#include "compare/results/shard_order.h"

#include "scenes/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace shadowproof {

namespace {

std::uint64_t number_of(const IndexedResults& run, const char* member = "number") {
    return run.head.at("shard").at(member).get<std::uint64_t>();
}

std::string words_of(const IndexedResults& run) {
    return fmt::format("shard {}/{}", number_of(run), number_of(run, "of"));
}

} // namespace

bool is_shard(const IndexedResults& run) {
    return run.head.contains("shard");
}

void order_shards(std::vector<IndexedResults>& runs) {
    std::stable_sort(runs.begin(), runs.end(), [](const auto& a, const auto& b) {
        if (!is_shard(a) || !is_shard(b)) return is_shard(a) && !is_shard(b);
        return number_of(a) < number_of(b);
    });
    if (!is_shard(runs.front())) return;
    const IndexedResults& first = runs.front();
    std::uint64_t expected = 1;
    for (const IndexedResults& run : runs) {
        if (!is_shard(run)) break;
        for (const char* member : {"of", "run"})
            if (run.head.at("shard").at(member) != first.head.at("shard").at(member))
                throw Error(run.path.string(),
                            fmt::format("is {} of another run than {}, {}", words_of(run),
                                        first.path.string(), words_of(first)),
                            "join the shards of one command, with the same scenes, techniques and "
                            "settings");
        if (number_of(run) < expected)
            throw Error(run.path.string(),
                        fmt::format("is {}, which was given already", words_of(run)),
                        "name each shard once");
        if (number_of(run) > expected) break;
        ++expected;
    }
    if (const std::uint64_t of = number_of(first, "of"); expected <= of)
        throw Error(
            first.path.string(),
            fmt::format("is {}, and shard {}/{} is not there", words_of(first), expected, of),
            "name the reports of all shards; one that was cut off goes on with --resume");
}

} // namespace shadowproof
