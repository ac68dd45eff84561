// What docs/results.schema.json says, as code. By hand, because valijson 1.0, Debian's library for
// JSON Schema in C++, overflows the stack where a pattern meets a string of 40 kB, which cause maps
// reach, and does not say which member of an object has a wrong name.
#pragma once

#include "compare/json/json_file.h"

#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace shadowproof {

/// Throws Error naming `file`, the JSON pointer of the first value that is not as it must be, and
/// the remedy. Beyond the schema's rules: sums and cause maps must agree with the counts, and
/// pictures must lie in the folder of their scene.
void check_results(const ResultsJson& results, const std::string& file);

/// The same where the scenes come one after the other.
class ResultsCheck {
public:
    explicit ResultsCheck(std::string file) : file_(std::move(file)) {}

    void next(const ResultsJson& scene);
    /// After the last scene: all the rest.
    void end(const ResultsJson& results) const;

private:
    std::string file_;
    std::size_t scenes_ = 0;
    std::set<std::string> folders_;
    bool any_fails_ = false;
};

/// Its first part: whether these are results, and in a format that this program knows.
void check_schema(const ResultsJson& results, const std::string& file);

/// "^[A-Za-z0-9_-]+$": a folder's name without a path.
bool is_plain_name(std::string_view name);

/// Plain names joined by '+': "bump_three_pass+zpass", which has that folder, too.
bool is_technique_name(std::string_view name);

/// Whether the scene, or the cell, holds nothing but the reason why it could not run.
bool could_not_run(const ResultsJson& scene_or_cell);

/// Whether anything in the scene fails the run.
bool scene_fails(const ResultsJson& scene);

/// Whether a run, or a cell that names its gate, was judged by the same gate as another.
bool has_same_gate(const ResultsJson& a, const ResultsJson& b);

} // namespace shadowproof
