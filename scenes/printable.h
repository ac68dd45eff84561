// Text from files and people for a line that a person reads.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace shadowproof {

/// U+FFFD, which stands for whatever a text may not hold.
inline constexpr std::string_view replacement_character = "\xEF\xBF\xBD";

/// For one line of a terminal: control characters (C0 with NUL and line ends, DEL, C1), line and
/// paragraph separators, marks that reorder a line (Unicode's bidirectional controls) and bytes
/// that are not UTF-8 become U+FFFD, so that a name can neither colour, move, cut nor hide
/// anything.
std::string printable(std::string_view text);

/// Printable, and short enough to be read: of a longer text the first 3000 bytes or so and the last
/// 800, between which "..." stands. A file may hold a string of any length.
std::string message(std::string_view text);

/// Each character (UTF-8, RFC 3629) of the text through `write(result, character)`, which appends
/// it or what stands for it; U+FFFD for each byte that begins none.
std::string
each_character(std::string_view text,
               const std::function<void(std::string& result, std::string_view character)>& write);

} // namespace shadowproof
