#include "compare/gate.h"

#include "compare/cell.h"
#include "compare/evidence.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

namespace shadowproof {

namespace {

constexpr auto index_of(Cause cause) {
    return static_cast<std::size_t>(cause);
}

/// Before any allowance.
std::uint64_t pixels_against(const Cell& cell, const Gate& gate, Cause cause) {
    const std::uint64_t all = cell.comparison.causes[index_of(cause)];
    if (cause == Cause::edge) return 0;
    const bool is_accepted = std::any_of(cell.accepted.begin(), cell.accepted.end(),
                                         [&](const Acceptance& one) { return one.cause == cause; });
    if (is_accepted && cell.since) return cell.since->causes[index_of(cause)];
    if (cause == Cause::unexplained) return all;
    if (gate.on == GateOn::differences)
        return cell.since ? cell.since->causes[index_of(cause)] : all;
    const auto& excused = cell.excused;
    return std::find(excused.begin(), excused.end(), cause) == excused.end() ? all : 0;
}

bool allows(const Gate& gate, Cause cause, std::uint64_t pixels) {
    return std::any_of(gate.allow.begin(), gate.allow.end(), [&](const Allowance& allowance) {
        return allowance.cause == cause && pixels <= allowance.pixels.value_or(pixels);
    });
}

CausePixels split(const Cell& cell, const Gate& gate, bool allowed) {
    CausePixels found{};
    for (const CauseWords& words : all_causes) {
        const std::uint64_t pixels = pixels_against(cell, gate, words.cause);
        if (allows(gate, words.cause, pixels) == allowed) found[index_of(words.cause)] = pixels;
    }
    return found;
}

std::string names_that_can_be_allowed() {
    std::string names;
    for (const CauseWords& words : all_causes)
        if (words.cause != Cause::unexplained)
            names += fmt::format("{}{}", names.empty() ? "" : ", ", words.name);
    return names;
}

} // namespace

CausePixels pixels_that_fail(const Cell& cell, const Gate& gate) {
    return split(cell, gate, false);
}

CausePixels pixels_allowed(const Cell& cell, const Gate& gate) {
    return split(cell, gate, true);
}

bool fails(const Cell& cell, const Gate& gate) {
    if (!cell.error.empty() || !unexplained_evidence(cell.comparison).empty()) return true;
    const CausePixels pixels = pixels_that_fail(cell, gate);
    return std::any_of(pixels.begin(), pixels.end(), [](std::uint64_t n) { return n > 0; });
}

bool fails(const SceneResult& scene, const Gate& gate) {
    return !scene.error.empty() || !scene.no_longer_provoked.empty() ||
           std::any_of(scene.cells.begin(), scene.cells.end(),
                       [&](const Cell& cell) { return fails(cell, gate); });
}

std::optional<FirstDifference> first_that_fails(const Cell& cell, const Gate& gate) {
    const CausePixels pixels = pixels_that_fail(cell, gate);
    const auto counts = [&](Cause cause) { return pixels[index_of(cause)] > 0; };
    if (gate.on == GateOn::differences && cell.since)
        for (const auto& change : {cell.since->first_new, cell.since->first_changed})
            if (change && change->cause && counts(*change->cause))
                return FirstDifference{change->x, change->y, *change->cause};
    const Image<std::uint8_t>& causes = cell.comparison.cause;
    for (int y = 0; y < causes.height; ++y)
        for (int x = 0; x < causes.width; ++x)
            if (causes.at(x, y) != no_difference && counts(static_cast<Cause>(causes.at(x, y))))
                return FirstDifference{x, y, static_cast<Cause>(causes.at(x, y))};
    return std::nullopt;
}

Allowance parse_allowance(const std::string& text) {
    const std::size_t equals = text.find('=');
    const std::string name = text.substr(0, equals);
    const std::optional<Cause> cause = cause_named(name);
    if (!cause)
        throw std::invalid_argument(
            fmt::format("there is no cause '{}'; there are {}", name, names_that_can_be_allowed()));
    if (*cause == Cause::unexplained)
        throw std::invalid_argument("unexplained pixels cannot be allowed: nobody knows what they "
                                    "hide; find their cause, and allow that");
    Allowance allowance{.cause = *cause, .pixels = {}};
    if (equals == std::string::npos) return allowance;
    const char* begin = text.data() + equals + 1;
    const char* end = text.data() + text.size();
    const auto [parsed, error] = std::from_chars(begin, end, allowance.pixels.emplace());
    if (error != std::errc() || parsed != end)
        throw std::invalid_argument(fmt::format("'{}' is no number of pixels; give {} or {}=12",
                                                text.substr(equals + 1), name, name));
    return allowance;
}

std::string words_of(const Allowance& allowance) {
    return allowance.pixels ? fmt::format("{}={}", name_of(allowance.cause), *allowance.pixels)
                            : std::string(name_of(allowance.cause));
}

std::string_view name_of(GateOn on) {
    return on == GateOn::defects ? "defects" : "differences";
}

} // namespace shadowproof
