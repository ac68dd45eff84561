#include "compare/results/results_file.h"

#include "compare/results/results_check.h"

#include <system_error>

namespace shadowproof {

namespace {

namespace fs = std::filesystem;

constexpr JsonRemedies of_results{"name a results.json, or the folder of a report",
                                  "give the whole results.json that shadowproof wrote"};

} // namespace

ResultsJson parse_results(const std::string& text, const std::string& file) {
    ResultsJson results = parse_json(text, file, of_results);
    check_results(results, file);
    return results;
}

ResultsFile read_results(const fs::path& path, MemoryAccount* memory) {
    std::error_code ignored;
    const fs::path file = fs::is_directory(path, ignored) ? path / "results.json" : path;
    return {file, parse_results(json_text(file, of_results, memory), file.string())};
}

} // namespace shadowproof
