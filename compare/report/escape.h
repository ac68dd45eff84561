// Escapes text from files and users for the format that it is written to. Bytes that are not UTF-8
// become U+FFFD, except in a shell's word.
#pragma once

#include "scenes/printable.h"

#include <string>
#include <string_view>

namespace shadowproof {

/// For HTML and XML, also between quotes. Control characters that XML forbids become U+FFFD.
std::string escaped(std::string_view text);

/// For a cell of a table in GitHub's Markdown: printable, and without effect as markup.
std::string for_markdown(std::string_view text);

/// For the message of a GitHub workflow command (`::error ...::message`), which ends at a line end.
std::string for_workflow(std::string_view message);
/// For a property of one (`title=`), which ends at a comma or colon too.
std::string for_workflow_property(std::string_view value);

/// One word for a POSIX shell: unchanged if no character is special there, else in single quotes.
std::string shell_quoted(std::string_view word);

} // namespace shadowproof
