// Completion of the program's command lines in bash.
#pragma once

#include "compare/command/manual/command_line.h"

#include <span>
#include <string>

namespace shadowproof {

/// A script for bash 4.4 or later, which needs no other package. It offers commands, options, names
/// of scenes, techniques and causes, choices, files and folders. `commands`: command_line_of().
std::string bash_completion(std::span<const CommandWords> commands);

} // namespace shadowproof
