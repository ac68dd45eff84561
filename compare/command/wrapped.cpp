#include "compare/command/wrapped.h"

#include <algorithm>
#include <string>

namespace shadowproof {

namespace {

constexpr std::size_t deepest = 30; ///< the column at which CLI11 describes flags

std::size_t indentation_of(const std::string& line) {
    const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
    const std::size_t gap = line.rfind("  ");
    const bool has_columns = gap != std::string::npos && gap > begin && gap + 2 < line.size();
    return std::min(has_columns ? gap + 2 : begin, deepest);
}

void put_wrapped(std::string line, std::size_t columns, std::string& result) {
    const std::size_t indentation = indentation_of(line);
    while (line.size() > columns) {
        std::size_t at = line.rfind(' ', columns);
        // Never within the indentation: a long word goes beyond the columns instead.
        if (at == std::string::npos || line.find_first_not_of(' ') >= at)
            at = line.find(' ', columns);
        if (at == std::string::npos) break;
        const std::string rest = line.substr(at + 1);
        line.resize(at);
        result += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
        line = std::string(indentation, ' ') + rest;
    }
    result += line + '\n';
}

} // namespace

std::string wrapped(const std::string& text, std::size_t columns) {
    std::string result;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        put_wrapped(text.substr(begin, end - begin), columns, result);
        begin = end + 1;
    }
    return result;
}

} // namespace shadowproof
