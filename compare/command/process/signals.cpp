#include "compare/command/process/signals.h"

#include "compare/command/process/exit_code.h"
#include "compare/output/unfinished.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string>
#include <string_view>
#include <thread>

namespace shadowproof {

namespace {

// Global, as signals are sent to the process.
std::atomic<pid_t> running_child = -1;
std::atomic<int> pipe_of_child = -1;
std::atomic<pid_t> owner = -1;
std::atomic<bool> is_ending = false;
/// Never changed after the program has begun its work; never destroyed, as the thread that waits
/// for signals may outlive main().
std::string& fate() {
    static auto* const words = new std::string("what was unfinished is removed");
    return *words;
}

/// Ignored signals stay ignored (nohup).
bool is_default(int signal) {
    struct sigaction action {};
    return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_DFL;
}

/// It may write where files are about to be removed.
void end_child() {
    const pid_t child = running_child;
    if (child <= 0) return;
    kill(child, SIGKILL);
    wait_for_end_of(pipe_of_child);
}

[[noreturn]] void end_by(int signal) {
    is_ending = true;
    end_child();
    remove_unfinished();
    const std::string words = fmt::format("shadowproof: ended by signal {} ({}); {}\n", signal,
                                          strsignal(signal), fate());
    // A failed write is ignored: there is nowhere to report it.
    [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, words.data(), words.size());
    // The program ends by the signal itself, so that its parent can tell.
    sigset_t one;
    sigemptyset(&one);
    sigaddset(&one, signal);
    pthread_sigmask(SIG_UNBLOCK, &one, nullptr);
    std::raise(signal);
    _exit(128 + signal);
}

/// For an uncaught exception, such as a failed allocation in a thread of a library. Memory may be
/// short: nothing is allocated here. A child process crashes as usual, and its parent reports it.
[[noreturn]] void end_uncaught() {
    if (getpid() != owner) std::abort();
    is_ending = true;
    end_child();
    remove_unfinished();
    static constexpr std::string_view words =
        "shadowproof: ended by an error in a library's thread, as where memory runs out; "
        "nothing was written\n";
    // A failed write is ignored: there is nowhere to report it.
    [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, words.data(), words.size());
    _exit(exit_could_not);
}

[[noreturn]] void end_by_first_of(sigset_t signals) {
    int signal = 0;
    while (sigwait(&signals, &signal) != 0) {
    }
    end_by(signal);
}

} // namespace

void handle_signals() {
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    owner = getpid();
    std::set_terminate(end_uncaught);
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        if (is_default(signal)) sigaddset(&signals, signal);
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    std::thread(end_by_first_of, signals).detach();
}

void leave_unfinished(const std::string& words) {
    fate() = words;
}

void set_running_child(pid_t process, int pipe) {
    pipe_of_child = pipe;
    running_child = process;
}

void wait_for_end_of(int pipe) {
    std::array<char, 4096> ignored{};
    while (true) {
        const ssize_t got = read(pipe, ignored.data(), ignored.size());
        if (got == 0 || (got < 0 && errno != EINTR)) return;
    }
}

void wait_if_ending() {
    while (is_ending) pause();
}

} // namespace shadowproof
