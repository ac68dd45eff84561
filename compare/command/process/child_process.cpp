#include "compare/command/process/child_process.h"

#include "compare/command/process/signals.h"
#include "scenes/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <thread>

namespace shadowproof {

namespace {

/// Added to the code that a child's work returns. Libraries that run out of memory call exit() with
/// codes of their own, 1 or 127, which must not be taken for ours.
constexpr int by_work = 64;
constexpr int most_codes = 16;

[[noreturn]] void throw_no_process(int error) {
    throw Error("shadowproof", fmt::format("no process can be started ({})", std::strerror(error)),
                "see the limits on processes and memory (ulimit -u)");
}

/// Ends without the libraries' exit handlers: some wait for threads that only the parent has. So
/// LeakSanitizer, which checks at exit, does not check a child.
[[noreturn]] void end_child(int code) {
    std::fflush(nullptr);
    _exit(code);
}

/// Whether any thread of this process except the calling one is running, as the system reports.
bool others_are_at_work() {
    namespace fs = std::filesystem;
    const std::string own = std::to_string(gettid());
    std::error_code ignored;
    for (const fs::directory_entry& task : fs::directory_iterator("/proc/self/task", ignored)) {
        if (task.path().filename() == own) continue;
        std::ifstream file(task.path() / "stat");
        const std::string line{std::istreambuf_iterator<char>(file), {}};
        const std::size_t name_end = line.rfind(") "); // "4711 (name) S ..."
        if (name_end != std::string::npos && line[name_end + 2] != 'S') return true;
    }
    return false;
}

/// Libraries start threads while they are loaded (log4cplus, which comes with OpenImageIO once a
/// picture needs it). One that is still starting may hold a lock, such as an allocator's, that
/// would never be released in a child: waits until all of them sleep.
void let_other_threads_settle() {
    constexpr int most_tries = 2000;
    constexpr std::chrono::milliseconds moment{1};
    for (int i = 0; i < most_tries && others_are_at_work(); ++i)
        std::this_thread::sleep_for(moment);
}

} // namespace

std::string words_of(const ChildEnd& end) {
    if (end.code) return fmt::format("ended with code {}", *end.code);
    if (end.signal == 0)
        return fmt::format("was ended by a library, with code {}, as where memory runs out",
                           end.library_code);
    std::string words =
        fmt::format("was ended by signal {} ({})", end.signal, strsignal(end.signal));
    // SIGKILL without an explanation nearly always comes from the kernel.
    if (end.signal == SIGKILL) words += ", as systems do where memory runs out";
    return words;
}

ChildProcess::ChildProcess(const std::function<int(int pipe)>& work) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw_no_process(errno);
    let_other_threads_settle();
    // Buffered output would be printed twice.
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
        end_child(by_work + work(ends[1]));
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
    ChildEnd end;
    if (WIFSIGNALED(status))
        end.signal = WTERMSIG(status);
    else if (const int code = WEXITSTATUS(status) - by_work; code >= 0 && code < most_codes)
        end.code = code;
    else
        end.library_code = WEXITSTATUS(status);
    return end;
}

} // namespace shadowproof
