// results.json and results.js written scene by scene, so that they may be larger than memory.
#pragma once

#include "compare/json/json_file.h"
#include "compare/output/replaced_folder.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace shadowproof {

class GrowingResults {
public:
    /// `head`: the results, whose "scenes" is an empty list. `requested`: another name in the
    /// folder under which the user wants results.json, too.
    GrowingResults(ReplacedFolder& files, ResultsJson head,
                   const std::optional<std::string>& requested);

    /// A scene with its cells. Throws Error where it cannot be written.
    void add(const ResultsJson& scene);
    /// After the last one. Throws Error.
    void end();

private:
    ResultsJson head_;
    std::vector<ReplacedFolder::GrowingFile> texts_; ///< all the same
    ReplacedFolder::GrowingFile script_;
    bool empty_ = true; ///< no scene yet

    void write(std::string_view text);
    void write_members(bool behind_scenes);
};

} // namespace shadowproof
