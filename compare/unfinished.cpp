#include "compare/unfinished.h"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <set>
#include <thread>

namespace shadowproof {

namespace {

/// Signals come to the process, so this is the process's. Never destroyed: the thread that waits
/// for signals may outlive main().
struct Registry {
    std::recursive_mutex guard;
    std::set<std::filesystem::path> paths;
};
Registry& registry() {
    static auto* const the_one = new Registry;
    return *the_one;
}

/// Ignored signals stay ignored (nohup).
bool is_default(int signal) {
    struct sigaction action {};
    return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_DFL;
}

[[noreturn]] void wait_and_remove(sigset_t signals) {
    int signal = 0;
    while (sigwait(&signals, &signal) != 0) {
    }
    // Never unlocked: nobody writes until the end.
    registry().guard.lock();
    std::error_code ignored;
    for (const std::filesystem::path& path : registry().paths)
        std::filesystem::remove_all(path, ignored);
    // The program ends as the signal ends programs, and its parent can tell.
    sigset_t one;
    sigemptyset(&one);
    sigaddset(&one, signal);
    pthread_sigmask(SIG_UNBLOCK, &one, nullptr);
    std::raise(signal);
    _exit(128 + signal);
}

} // namespace

Unfinished::Unfinished(const std::filesystem::path& place)
    : path_(fmt::format("{}.writing-{}", place.string(), getpid())) {
    const auto lock = hold_unfinished();
    registry().paths.insert(path_);
}

Unfinished::~Unfinished() {
    const auto lock = hold_unfinished();
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
    registry().paths.erase(path_);
}

std::unique_lock<std::recursive_mutex> hold_unfinished() {
    return std::unique_lock(registry().guard);
}

void remove_unfinished_at_signals() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        if (is_default(signal)) sigaddset(&signals, signal);
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    std::thread(wait_and_remove, signals).detach();
}

} // namespace shadowproof
