// Examples of command lines, for --help and the manual page.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace shadowproof {

struct CommandExample {
    std::string_view command; ///< "verify"
    std::string_view words;   ///< the whole command line
    std::string_view meaning;
};

/// The first of each command is the one that stands for it.
std::span<const CommandExample> command_examples();

struct ExitCodeWords {
    int code;
    std::string_view meaning;
};

/// Those of commands that judge.
std::span<const ExitCodeWords> exit_code_words();

/// What follows the options in the help of a command; "": of the program.
std::string help_footer(std::string_view command);

} // namespace shadowproof
