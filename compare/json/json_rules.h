// Rules that values of JSON are held to, for the checks of the files that this program writes and
// reads back. One rule per function, named as in the schemas.
#pragma once

#include "compare/json/json_place.h"
#include "scenes/cause.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <numeric>
#include <string_view>

namespace shadowproof::json_rules {

using Rule = void (*)(const JsonPlace&);

/// Integers up to here are the same in every reader of JSON (RFC 8259, 6).
inline constexpr std::uint64_t largest_count = std::uint64_t{1} << 53U;

inline bool is_count(const ResultsJson& value, std::uint64_t least) {
    return value.is_number_unsigned() && value.get<std::uint64_t>() >= least &&
           value.get<std::uint64_t>() <= largest_count;
}

inline void text(const JsonPlace& place) {
    require(place.value.is_string(), place, "a string");
}
inline void some_text(const JsonPlace& place) {
    require(place.value.is_string() && !place.value.get_ref<const std::string&>().empty(), place,
            "a string that is not empty");
}
inline void boolean(const JsonPlace& place) {
    require(place.value.is_boolean(), place, "true or false");
}
inline void count(const JsonPlace& place) {
    require(is_count(place.value, 0), place, "a whole number from 0");
}
inline void whole_number(const JsonPlace& place) {
    require(place.value.is_number_integer(), place, "a whole number");
}
inline void size(const JsonPlace& place) {
    require(is_count(place.value, 1), place, "a whole number from 1");
}
inline void amount(const JsonPlace& place) {
    require(place.value.is_number() && place.value.get<double>() >= 0, place, "a number from 0");
}
inline void milliseconds(const JsonPlace& place) {
    amount(place);
}
inline void number(const JsonPlace& place) {
    require(place.value.is_number(), place, "a number");
}
inline void cause(const JsonPlace& place) {
    require(place.value.is_string() && cause_named(place.value.get_ref<const std::string&>()),
            place, "the name of a cause");
}

inline void one_of(const JsonPlace& place, std::initializer_list<std::string_view> names) {
    const bool holds =
        std::any_of(names.begin(), names.end(), [&](auto name) { return place.value == name; });
    require(holds, place, fmt::format("one of {}", fmt::join(names, ", ")));
}

template <Rule rule>
inline void list_of(const JsonPlace& place) {
    require(place.value.is_array(), place, "an array");
    for (std::size_t i = 0; i < place.value.size(); ++i) rule(place.at(i));
}

/// Every run tries something: an empty list must not pass.
template <Rule rule>
inline void some_of(const JsonPlace& place) {
    require(place.value.is_array() && !place.value.empty(), place, "an array that is not empty");
    list_of<rule>(place);
}

enum class Need : std::uint8_t { required, optional };

struct Member {
    const char* name;
    Rule rule;
    Need need = Need::required;
};

/// Members that are not in the table are from a newer writer.
inline void object(const JsonPlace& place, std::initializer_list<Member> members) {
    require(place.value.is_object(), place, "an object");
    for (const Member& member : members) {
        if (place.value.contains(member.name)) {
            member.rule(place.at(member.name));
        } else if (member.need == Need::required) {
            refuse(place, fmt::format("lacks \"{}\"", member.name));
        }
    }
}

inline void gl(const JsonPlace& place) {
    object(place, {{"version", text},
                   {"renderer", text},
                   {"subpixel_bits", count},
                   {"depth_bits", count},
                   {"stencil_bits", count}});
}

inline void causes(const JsonPlace& place) {
    require(place.value.is_object(), place, "an object");
    for (const auto& [name, pixels] : place.value.items()) {
        if (!cause_named(name))
            refuse(place, fmt::format("names a cause that there is not: {}", shown(name)));
        size(place.at(name));
    }
}

/// The sum of members that are counts.
inline std::uint64_t sum(const ResultsJson& figures, std::initializer_list<const char*> names) {
    return std::accumulate(names.begin(), names.end(), std::uint64_t{0},
                           [&](std::uint64_t total, const char* name) {
                               return total + figures.at(name).get<std::uint64_t>();
                           });
}

/// `of`: what the sum must equal.
inline void require_sum(const JsonPlace& place, std::uint64_t is, std::uint64_t must_be,
                        const char* of) {
    if (is != must_be) refuse(place, fmt::format("adds up to {}, but {} is {}", is, of, must_be));
}

} // namespace shadowproof::json_rules
