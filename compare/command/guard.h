// A command's work in a child process, so that a crash in it, of ours or of a library, ends with a
// sentence and exit code 3.
#pragma once

#include "compare/command/options.h"

#include <string>

namespace shadowproof {

/// Runs the work, and says what it throws on standard error. Returns its exit code.
int run_to_exit_code(const Work& work) noexcept;

/// The same in a child process. `report`: the folder of the report that the work writes, none where
/// empty; what the child leaves unfinished of it, where it crashes or a signal ends the program, is
/// removed.
int guarded(const Work& work, const std::string& report = {});

} // namespace shadowproof
