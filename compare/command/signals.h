// What becomes of the program when a signal ends it, or an exception that nobody catches: its child
// goes first, then what is unfinished, and it says what happened.
#pragma once

#include <sys/types.h>

namespace shadowproof {

/// From here on SIGINT, SIGTERM and SIGHUP leave nothing unfinished behind; SIGPIPE and SIGXFSZ
/// end nothing: what cannot be written is an error where it is written. An exception that leaves a
/// thread of a library ends this process with a sentence and exit_could_not; a child of it crashes.
/// To be called once, before any other thread is started: they inherit what is blocked.
void handle_signals();

/// The child to be killed first, and the pipe that ends with it; -1: none.
void set_running_child(pid_t process, int pipe);

/// Waits until nobody holds the writing end of a pipe: a child and the children that die with it.
void wait_for_end_of(int pipe);

/// Does not return where a signal is ending the program: its child's end is no news then.
void wait_if_ending();

} // namespace shadowproof
