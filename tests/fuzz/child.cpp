#include "tests/fuzz/child.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <stdexcept>

namespace shadowproof::fuzz {

namespace {

void limit(int resource, std::uint64_t most) {
    const rlimit both{most, most};
    setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

/// In the child: never returns.
[[noreturn]] void become(const std::vector<std::string>& command,
                         const std::filesystem::path& output, const std::filesystem::path& error,
                         const ChildLimits& limits) {
    std::vector<char*> words;
    for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    dup2(open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644), STDOUT_FILENO);
    dup2(open(error.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644), STDERR_FILENO);
    limit(RLIMIT_CPU, limits.processor_seconds);
    limit(RLIMIT_AS, limits.address_bytes);
    limit(RLIMIT_CORE, 0);
    execv(words.front(), words.data());
    _exit(127);
}

double seconds_of(const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
}

} // namespace

ChildResult run_child(const std::vector<std::string>& command, const std::filesystem::path& output,
                      const std::filesystem::path& error, const ChildLimits& limits) {
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("no process can be made");
    if (child == 0) {
        setpgid(0, 0); // so that its own children can be killed with it
        become(command, output, error, limits);
    }
    ChildResult result;
    int status = 0;
    rusage usage{};
    constexpr timespec pause{0, 5'000'000};
    timespec begin{};
    clock_gettime(CLOCK_MONOTONIC, &begin);
    while (wait4(child, &status, WNOHANG, &usage) == 0) {
        timespec now{};
        clock_gettime(CLOCK_MONOTONIC, &now);
        if (!result.timed_out && now.tv_sec - begin.tv_sec > limits.wall_seconds) {
            result.timed_out = true;
            kill(-child, SIGKILL);
        }
        nanosleep(&pause, nullptr);
    }
    if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
    result.processor_seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
    result.most_memory = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
    return result;
}

} // namespace shadowproof::fuzz
