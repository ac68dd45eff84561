#include "compare/escape.h"

#include <fmt/format.h>

#include <algorithm>

namespace shadowproof {

namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD"; // U+FFFD

/// Bytes of the UTF-8 sequence that text begins with; 0 where it begins with none (RFC 3629, 4).
std::size_t utf8_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char first = byte(0);
    if (first < 0x80) return 1;
    std::size_t length = 0;
    if (first >= 0xC2 && first <= 0xDF) length = 2;
    if (first >= 0xE0 && first <= 0xEF) length = 3;
    if (first >= 0xF0 && first <= 0xF4) length = 4;
    if (length == 0 || text.size() < length) return 0;
    for (std::size_t i = 1; i < length; ++i)
        if (byte(i) < 0x80 || byte(i) > 0xBF) return 0;
    const unsigned char second = byte(1);
    const bool overlong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
    const bool surrogate = first == 0xED && second > 0x9F;
    const bool beyond = first == 0xF4 && second > 0x8F;
    return overlong || surrogate || beyond ? 0 : length;
}

/// Each character of the text through `write`, which appends it, or what stands for it.
template <class Write>
std::string each_character(std::string_view text, Write write) {
    std::string result;
    result.reserve(text.size());
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = utf8_length(text.substr(i));
        if (length == 0) {
            result += replacement;
        } else {
            write(result, text.substr(i, length));
        }
        i += length == 0 ? 1 : length;
    }
    return result;
}

bool is_control(std::string_view character) {
    const auto first = static_cast<unsigned char>(character[0]);
    // U+0080 to U+009F, the C1 set, are C2 80 to C2 9F.
    const bool c1 = first == 0xC2 && static_cast<unsigned char>(character[1]) < 0xA0;
    return first < 0x20 || first == 0x7F || c1;
}

/// The three control characters that XML lets in (XML 1.0, 2.2).
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
            result += replacement;
        else
            result += named.empty() ? character : named;
    });
}

std::string printable(std::string_view text) {
    return each_character(text, [](std::string& result, std::string_view character) {
        result += is_control(character) ? replacement : character;
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
