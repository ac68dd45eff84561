#include "compare/results/results_file.h"

#include "compare/results/results_check.h"

#include <system_error>

namespace shadowproof {

namespace fs = std::filesystem;

fs::path results_path(const fs::path& path) {
    std::error_code ignored;
    return fs::is_directory(path, ignored) ? path / "results.json" : path;
}

ResultsJson parse_results(const std::string& text, const std::string& file) {
    ResultsJson results = parse_json(text, file, results_remedies);
    check_results(results, file);
    return results;
}

ResultsFile read_results(const fs::path& path, MemoryAccount* memory) {
    const fs::path file = results_path(path);
    return {file, parse_results(json_text(file, results_remedies, memory), file.string())};
}

} // namespace shadowproof
