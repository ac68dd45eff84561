// The manual page, for man(1).
#pragma once

#include "compare/command/manual/command_line.h"

#include <span>
#include <string>

namespace shadowproof {

/// As man(7) has it. `commands`: command_line_of().
std::string man_page(std::span<const CommandWords> commands, const std::string& version);

} // namespace shadowproof
