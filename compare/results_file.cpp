#include "compare/results_file.h"

#include "compare/results_check.h"
#include "scenes/error.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

namespace shadowproof {

namespace {

namespace fs = std::filesystem;

/// Results nest nine deep. What follows goes by recursion, which a file must not make overflow.
constexpr int deepest = 64;

constexpr const char* give_whole = "give the whole results.json that shadowproof wrote";

std::string text_of(const fs::path& file) {
    std::error_code ignored;
    if (!fs::exists(file, ignored))
        throw Error(file.string(), "there is no such file",
                    "name a results.json, or the folder of a report");
    errno = 0;
    std::ifstream stream(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    // A directory opens, and fails at its first byte.
    if (!stream.is_open() || stream.bad() || !fs::is_regular_file(file, ignored))
        throw Error(file.string(),
                    fmt::format("cannot be read ({})",
                                errno != 0 ? std::strerror(errno) : "it is not a file"),
                    "name a results.json, or the folder of a report");
    return text;
}

/// Where the parser stopped: behind the last byte there is nothing wrong but that it is the last.
[[noreturn]] void throw_not_json(const std::string& text, const std::string& file,
                                 std::size_t byte) {
    if (text.empty()) throw Error(file, "is empty", give_whole);
    if (byte > text.size())
        throw Error(file, fmt::format("is cut off after byte {}", text.size()), give_whole);
    throw Error(file, fmt::format("is not JSON at byte {}", byte), give_whole);
}

} // namespace

ResultsJson parse_results(const std::string& text, const std::string& file) {
    const auto not_too_deep = [&](int depth, ResultsJson::parse_event_t, ResultsJson&) {
        if (depth > deepest)
            throw Error(file, fmt::format("nests deeper than {}", deepest), give_whole);
        return true;
    };
    ResultsJson results;
    try {
        results = ResultsJson::parse(text, not_too_deep);
    } catch (const ResultsJson::parse_error& error) {
        throw_not_json(text, file, error.byte);
    } catch (const ResultsJson::out_of_range&) {
        throw Error(file, "holds a number beyond every double", give_whole);
    }
    check_results(results, file);
    return results;
}

ResultsFile read_results(const fs::path& path) {
    std::error_code ignored;
    const fs::path file = fs::is_directory(path, ignored) ? path / "results.json" : path;
    return {file, parse_results(text_of(file), file.string())};
}

std::string results_text(const ResultsJson& results) {
    return results.dump(1, ' ', false, ResultsJson::error_handler_t::replace) + "\n";
}

std::string shown(const ResultsJson& value) {
    constexpr std::size_t longest = 60; // bytes: beside two file names on a line
    std::string text = value.dump(-1, ' ', true, ResultsJson::error_handler_t::replace);
    if (text.size() > longest) text = text.substr(0, longest - 3) + "...";
    return text;
}

} // namespace shadowproof
