#include "scenes/printable.h"

#include <algorithm>
#include <array>

namespace shadowproof {

namespace {

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

bool is_control(std::string_view character) {
    const auto first = static_cast<unsigned char>(character[0]);
    // U+0080 to U+009F, the C1 set, are C2 80 to C2 9F.
    const bool c1 = first == 0xC2 && static_cast<unsigned char>(character[1]) < 0xA0;
    return first < 0x20 || first == 0x7F || c1;
}

/// Unicode's Bidi_Control, and the two separators that end a line.
bool moves_text(std::string_view character) {
    constexpr std::array<std::string_view, 14> marks{
        "\u061C", "\u200E", "\u200F", "\u202A", "\u202B", "\u202C", "\u202D",
        "\u202E", "\u2066", "\u2067", "\u2068", "\u2069", "\u2028", "\u2029"};
    return std::find(marks.begin(), marks.end(), character) != marks.end();
}

} // namespace

std::string
each_character(std::string_view text,
               const std::function<void(std::string& result, std::string_view character)>& write) {
    std::string result;
    result.reserve(text.size());
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = utf8_length(text.substr(i));
        if (length == 0)
            result += replacement_character;
        else
            write(result, text.substr(i, length));
        i += length == 0 ? 1 : length;
    }
    return result;
}

std::string printable(std::string_view text) {
    return each_character(text, [](std::string& result, std::string_view character) {
        result +=
            is_control(character) || moves_text(character) ? replacement_character : character;
    });
}

std::string message(std::string_view text) {
    constexpr std::size_t first = 3000;
    constexpr std::size_t last = 800;
    if (text.size() <= first + last) return printable(text);
    // Between characters, where it is UTF-8.
    const auto continues = [&](std::size_t at) {
        return (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80;
    };
    std::size_t end = first;
    while (end > first - 3 && continues(end)) --end;
    std::size_t begin = text.size() - last;
    while (begin < text.size() - last + 3 && continues(begin)) ++begin;
    return printable(text.substr(0, end)) + "..." + printable(text.substr(begin));
}

} // namespace shadowproof
