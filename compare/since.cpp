#include "compare/since.h"

#include "compare/classify.h"
#include "compare/words.h"

#include <fmt/format.h>

#include <cassert>

namespace shadowproof {

namespace {

std::optional<Cause> cause_of(std::uint8_t value) {
    return value == no_difference ? std::nullopt : std::optional(static_cast<Cause>(value));
}

bool beyond_edge(const PixelChange& change) {
    return change.cause.value_or(Cause::edge) != Cause::edge ||
           change.was.value_or(Cause::edge) != Cause::edge;
}

void count(std::uint64_t& pixels, std::optional<PixelChange>& first, const PixelChange& change) {
    ++pixels;
    if (!first || (!beyond_edge(*first) && beyond_edge(change))) first = change;
}

std::string words_of(const PixelChange& change) {
    return fmt::format("({},{}){}{}", change.x, change.y,
                       change.cause ? fmt::format(" {}", name_of(*change.cause)) : "",
                       change.was ? fmt::format(" was {}", name_of(*change.was)) : "");
}

} // namespace

Since changes_since(const Image<std::uint8_t>& was, const Image<std::uint8_t>& now) {
    assert(was.width == now.width && was.height == now.height);
    Since since;
    for (int y = 0; y < now.height; ++y) {
        for (int x = 0; x < now.width; ++x) {
            if (now.at(x, y) == was.at(x, y)) continue;
            const PixelChange change{x, y, cause_of(now.at(x, y)), cause_of(was.at(x, y))};
            if (change.cause) ++since.causes[static_cast<std::size_t>(*change.cause)];
            if (!change.was) {
                count(since.appeared, since.first_new, change);
            } else if (!change.cause) {
                count(since.gone, since.first_gone, change);
            } else {
                count(since.changed, since.first_changed, change);
            }
        }
    }
    return since;
}

std::optional<PixelChange> first_of(const Since& since) {
    for (const auto& change : {since.first_new, since.first_changed})
        if (change && change->cause != Cause::edge) return change;
    for (const auto& change : {since.first_new, since.first_changed, since.first_gone})
        if (change) return change;
    return std::nullopt;
}

std::string words_of(const Since& since) {
    std::string words;
    const auto add = [&](std::uint64_t pixels, std::string_view what,
                         const std::optional<PixelChange>& first) {
        if (pixels == 0) return;
        words += fmt::format("{}{} {}, first {}", words.empty() ? "" : "; ", grouped(pixels), what,
                             words_of(*first));
    };
    add(since.appeared, "new", since.first_new);
    add(since.gone, "gone", since.first_gone);
    add(since.changed, "of another cause", since.first_changed);
    return words.empty() ? "unchanged" : words;
}

} // namespace shadowproof
