#include "compare/command/child_process.h"

#include "compare/command/signals.h"
#include "scenes/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

namespace shadowproof {

namespace {

[[noreturn]] void throw_no_process(int error) {
    throw Error("shadowproof", fmt::format("no process can be started ({})", std::strerror(error)),
                "see the limits on processes and memory (ulimit -u)");
}

/// Without what libraries do at exit: some wait there for threads of theirs that are the parent's.
/// LeakSanitizer, which looks at exit, sees nothing of a child either.
[[noreturn]] void end_child(int code) {
    std::fflush(nullptr);
    _exit(code);
}

} // namespace

std::string words_of(const ChildEnd& end) {
    if (end.code) return fmt::format("ended with code {}", *end.code);
    std::string words =
        fmt::format("was ended by signal {} ({})", end.signal, strsignal(end.signal));
    // Who kills without a word is nearly always the kernel.
    if (end.signal == SIGKILL) words += ", as systems do where memory runs out";
    return words;
}

ChildProcess::ChildProcess(const std::function<int(int pipe)>& work) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw_no_process(errno);
    // What is buffered would be printed twice.
    std::fflush(nullptr);
    const pid_t parent = getpid();
    process_ = fork();
    if (process_ < 0) {
        const int error = errno;
        close(ends[0]);
        close(ends[1]);
        throw_no_process(error);
    }
    if (process_ == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (getppid() != parent) _exit(1); // it ended in between
        close(ends[0]);
        end_child(work(ends[1]));
    }
    close(ends[1]);
    pipe_ = ends[0];
    set_running_child(process_, pipe_);
}

ChildProcess::~ChildProcess() {
    if (process_ > 0) {
        kill();
        wait();
    }
    close(pipe_);
}

void ChildProcess::kill() {
    if (process_ > 0) ::kill(process_, SIGKILL);
}

ChildEnd ChildProcess::wait() {
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    wait_for_end_of(pipe_);
    process_ = -1;
    set_running_child(-1, -1);
    wait_if_ending();
    if (WIFSIGNALED(status)) return {.code = std::nullopt, .signal = WTERMSIG(status)};
    return {.code = WEXITSTATUS(status)};
}

} // namespace shadowproof
