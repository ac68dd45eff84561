#include "compare/report/escape.h"

#include <fmt/format.h>

#include <algorithm>

namespace shadowproof {

namespace {

/// The three control characters that XML allows (XML 1.0, 2.2).
bool is_space(char c) {
    return c == '\t' || c == '\n' || c == '\r';
}

std::string_view entity(char c) {
    switch (c) {
    case '&':
        return "&amp;";
    case '<':
        return "&lt;";
    case '>':
        return "&gt;";
    case '"':
        return "&quot;";
    case '\'':
        return "&#39;";
    default:
        return {};
    }
}

std::string percent_encoded(std::string_view text, std::string_view special) {
    std::string result;
    for (const char c : text)
        if (special.find(c) == std::string_view::npos)
            result += c;
        else
            result += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    return result;
}

} // namespace

std::string escaped(std::string_view text) {
    return each_character(text, [](std::string& result, std::string_view character) {
        const auto first = static_cast<unsigned char>(character[0]);
        const std::string_view named = entity(character[0]);
        const bool noncharacter = character == "\xEF\xBF\xBE" || character == "\xEF\xBF\xBF";
        if (noncharacter || (first < 0x20 && !is_space(character[0])))
            result += replacement_character;
        else
            result += named.empty() ? character : named;
    });
}

std::string for_markdown(std::string_view text) {
    return each_character(printable(text), [](std::string& result, std::string_view character) {
        const std::string_view named = entity(character[0]);
        if (std::string_view("\\`*_[]|#~:@").find(character[0]) != std::string_view::npos)
            result += fmt::format("&#{};", static_cast<int>(character[0]));
        else
            result += named.empty() ? character : named;
    });
}

std::string for_workflow(std::string_view message) {
    return percent_encoded(message, "%\r\n");
}

std::string for_workflow_property(std::string_view value) {
    return percent_encoded(value, "%\r\n:,");
}

std::string shell_quoted(std::string_view word) {
    const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               std::string_view("_-./,:=+@%").find(c) != std::string_view::npos;
    });
    if (plain) return std::string(word);
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

} // namespace shadowproof
