// Handles signals that end the program, and uncaught exceptions: kills the child, removes what is
// unfinished, and prints what happened.
#pragma once

#include <sys/types.h>

#include <string>

namespace shadowproof {

/// From here on SIGINT, SIGTERM and SIGHUP leave nothing unfinished behind. SIGPIPE and SIGXFSZ do
/// not end the program: the write that fails is an error. An uncaught exception in a library's
/// thread ends this process with a message and exit_could_not; in a child process it is a crash. To
/// be called once, before any other thread is started: threads inherit the blocked signals.
void handle_signals();

/// What is unfinished stays, and a signal that ends the program says `words` of that.
void leave_unfinished(const std::string& words);

/// The child to be killed first, and the pipe that ends with it; -1: none.
void set_running_child(pid_t process, int pipe);

/// Waits until no process holds the writing end of a pipe: the child and its own children have
/// ended.
void wait_for_end_of(int pipe);

/// Does not return if a signal is ending the program, so that its child's end is not reported.
void wait_if_ending();

} // namespace shadowproof
