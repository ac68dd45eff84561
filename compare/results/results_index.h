// results.json read one scene at a time: what joining several of them needs to know of all, and
// each scene whole when its turn comes. So a file may be larger than memory.
#pragma once

#include "compare/results/results_file.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace shadowproof {

struct IndexedCell {
    std::string name;
    bool could_not_run = false;
    bool fails = false;
    std::string verdict;      ///< empty: it has none
    std::string verified;     ///< the scene as its command names it, if that is a word of its own
    std::uint64_t causes = 0; ///< a bit for each of all_causes that it shows
};

struct IndexedScene {
    ResultsJson head; ///< without its cells: "techniques" is an empty list, where there is one
    std::vector<IndexedCell> cells;
};

struct IndexedResults {
    std::filesystem::path path;
    ResultsJson head; ///< without scenes: "scenes" is an empty list
    std::vector<IndexedScene> scenes;
    /// A scene with its cells. Throws Error naming the file where it cannot be read any more.
    std::function<ResultsJson(std::size_t)> scene;
};

/// Reads a file, as read_results does, with the same checks and errors. It must stay as it is for
/// `scene`.
/// What is kept is charged to the account, and each scene is required of it while it is read.
IndexedResults index_results(const std::filesystem::path& path, MemoryAccount& memory);

/// The same of results that are in memory, and were checked.
IndexedResults index_results(const ResultsFile& results);

} // namespace shadowproof
