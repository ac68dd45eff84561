// A value of a file of JSON with its place in it, and how it is refused.
#pragma once

#include "compare/json/json_file.h"
#include "scenes/error.h"

#include <fmt/format.h>

#include <string>

namespace shadowproof {

/// A value and where it stands. Keeps references to the file's name and to the value.
struct JsonPlace {
    const std::string& file;
    std::string pointer; ///< RFC 6901; empty: the whole file
    const ResultsJson& value;
    const char* remedy = "write the results again with shadowproof verify";

    JsonPlace at(const std::string& member) const {
        std::string escaped;
        for (const char c : member)
            escaped += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
        return {file, pointer + "/" + escaped, value.at(member), remedy};
    }
    JsonPlace at(std::size_t index) const {
        return {file, fmt::format("{}/{}", pointer, index), value.at(index), remedy};
    }
};

[[noreturn]] inline void refuse(const JsonPlace& place, const std::string& what,
                                const char* remedy = nullptr) {
    const std::string where = place.pointer.empty() ? "the whole" : place.pointer;
    throw Error(place.file, where + " " + what, remedy == nullptr ? place.remedy : remedy);
}

inline void require(bool holds, const JsonPlace& place, const std::string& what) {
    if (!holds) refuse(place, fmt::format("must be {}, but is {}", what, shown(place.value)));
}

} // namespace shadowproof
