// A value of a results file with its place in it, and how it is refused.
#pragma once

#include "compare/results/results_file.h"
#include "scenes/error.h"

#include <fmt/format.h>

#include <string>

namespace shadowproof {

/// A value and where it stands.
struct Place {
    const std::string& file;
    std::string pointer; ///< RFC 6901; empty: the whole file
    const ResultsJson& value;
    const char* remedy = "write the results again with shadowproof verify";

    Place at(const std::string& member) const {
        std::string escaped;
        for (const char c : member)
            escaped += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
        return {file, pointer + "/" + escaped, value.at(member), remedy};
    }
    Place at(std::size_t index) const {
        return {file, fmt::format("{}/{}", pointer, index), value.at(index), remedy};
    }
};

[[noreturn]] inline void refuse(const Place& place, const std::string& what,
                                const char* remedy = nullptr) {
    const std::string where = place.pointer.empty() ? "the whole" : place.pointer;
    throw Error(place.file, where + " " + what, remedy == nullptr ? place.remedy : remedy);
}

inline void require(bool holds, const Place& place, const std::string& what) {
    if (!holds) refuse(place, fmt::format("must be {}, but is {}", what, shown(place.value)));
}

/// Check the figures and paths of a cell, or a scene, whose members are as the schema says.
void check_cell_figures(const Place& cell, const ResultsJson& scene);
void check_scene_figures(const Place& scene);

} // namespace shadowproof
