// Makes text from files and users safe to print on one line.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace shadowproof {

/// U+FFFD, which replaces whatever may not be printed.
inline constexpr std::string_view replacement_character = "\xEF\xBF\xBD";

/// The text for one line of a terminal: control characters (C0 with NUL and line ends, DEL, C1),
/// line and paragraph separators, marks that reorder a line (Unicode's bidirectional controls) and
/// bytes that are not UTF-8 become U+FFFD. A name can then neither colour, move, cut nor hide
/// anything.
std::string printable(std::string_view text);

/// Printable and of bounded length: of a longer text the first 3000 bytes or so, "...", and the
/// last 800. A file may hold a string of any length.
std::string message(std::string_view text);

/// Passes each character (UTF-8, RFC 3629) of the text to `write(result, character)`, which appends
/// it or its replacement. U+FFFD is passed for each byte that begins no character.
std::string
each_character(std::string_view text,
               const std::function<void(std::string& result, std::string_view character)>& write);

} // namespace shadowproof
