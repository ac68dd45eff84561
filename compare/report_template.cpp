#include "compare/report_template.h"

#include <cassert>
#include <set>

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

} // namespace

std::string escaped(std::string_view text) {
    std::string result;
    result.reserve(text.size());
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = utf8_length(text.substr(i));
        const auto first = static_cast<unsigned char>(text[i]);
        const bool forbidden = first < 0x20 && first != '\t' && first != '\n' && first != '\r';
        const std::string_view named = entity(text[i]);
        if (length == 0 || forbidden) {
            result += replacement;
        } else {
            result += named.empty() ? text.substr(i, length) : named;
        }
        i += length == 0 ? 1 : length;
    }
    return result;
}

std::string fill(std::string_view text, const Gaps& values) {
    std::string result;
    [[maybe_unused]] std::set<std::string_view> used;
    for (;;) {
        const std::size_t open = text.find("{{");
        const std::size_t close = text.find("}}", open);
        result += text.substr(0, open);
        if (open == std::string_view::npos || close == std::string_view::npos) break;
        const auto value = values.find(text.substr(open + 2, close - open - 2));
        assert(value != values.end());
        if (value != values.end()) {
            result += value->second;
            used.insert(value->first);
        }
        text.remove_prefix(close + 2);
    }
    assert(used.size() == values.size());
    return result;
}

} // namespace shadowproof
