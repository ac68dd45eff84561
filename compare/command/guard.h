// Runs a command's work in a child process, so that a crash of this program or a library ends with
// a message and exit code 3, and a line says what has been taking longer than a minute.
#pragma once

#include "compare/command/options.h"

#include <functional>
#include <string>

namespace shadowproof {

/// Runs the work and prints what it throws to standard error. Returns its exit code.
int run_to_exit_code(const Work& work) noexcept;

/// Work that reports what it is doing, by a Console with this pipe as its watcher.
using WatchedWork = std::function<int(int watcher)>;

/// The same in a child process. `report`: the folder of the report that the work writes; empty if
/// none. If the child crashes or a signal ends the program, the unfinished report is removed. What
/// the child has been doing for a minute is said in a line, and again after twice as long.
int guarded(const WatchedWork& work, const std::string& report = {});

/// The same where the report stays unfinished, for a later process that goes on with it.
int guarded_resumable(const WatchedWork& work, const std::string& report);

/// The same for work that writes no report, given up after `seconds` (0: no limit). `what`: the
/// subject of the message then, such as a scene.
int guarded_within(double seconds, const std::string& what, const WatchedWork& work);

} // namespace shadowproof
