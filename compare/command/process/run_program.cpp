#include "compare/command/process/run_program.h"

#include "compare/command/process/child_process.h"
#include "compare/command/process/stopwatch.h"
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
#include <cstring>
#include <stdexcept>
#include <thread>

namespace shadowproof {

namespace {

/// In the child, between fork and exec: system calls alone. Never returns.
[[noreturn]] void become(char* const* words, int input, int output, int failure, pid_t parent) {
    setpgid(0, 0); // so that what it starts can be ended with it
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(1); // it ended in between
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    for (const int ignored : {SIGPIPE, SIGXFSZ}) signal(ignored, SIG_DFL);
    dup2(input, STDIN_FILENO);
    dup2(output, STDOUT_FILENO);
    dup2(output, STDERR_FILENO);
    execvp(words[0], words);
    const int error = errno;
    [[maybe_unused]] const ssize_t written = write(failure, &error, sizeof error);
    _exit(127);
}

class File {
public:
    File(const char* name, int flags) : number_(open(name, flags | O_CLOEXEC, 0600)) {
        if (number_ < 0)
            throw Error(name, fmt::format("cannot be opened ({})", std::strerror(errno)),
                        "check its folder, and the disk that it is on");
    }
    ~File() { close(number_); }
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    int number() const { return number_; }

private:
    int number_;
};

/// Whether the process has ended; it is not yet taken from the table of processes, so that its
/// number is still its own.
bool has_ended(pid_t process) {
    siginfo_t info{};
    while (waitid(P_PID, static_cast<id_t>(process), &info, WEXITED | WNOHANG | WNOWAIT) != 0)
        if (errno != EINTR) return true;
    return info.si_pid == process;
}

ProgramEnd wait_for(pid_t process, double seconds) {
    constexpr std::chrono::milliseconds moment{5};
    const Stopwatch since_start;
    ProgramEnd end;
    while (!has_ended(process) && !end.timed_out) {
        std::this_thread::sleep_for(moment);
        end.timed_out = seconds > 0 && since_start.milliseconds() > 1000 * seconds;
    }
    kill(-process, SIGKILL); // its group: what it has left running, or all of it
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    if (end.timed_out) return end;
    if (WIFSIGNALED(status))
        end.signal = WTERMSIG(status);
    else
        end.code = WEXITSTATUS(status);
    return end;
}

} // namespace

std::string words_of(const ProgramEnd& end) {
    if (end.timed_out) return "took too long";
    return words_of(ChildEnd{.code = end.code, .signal = end.signal, .library_code = 0});
}

ProgramEnd run_program(const std::vector<std::string>& words, const std::filesystem::path& log,
                       double seconds) {
    std::vector<std::string> copies = words;
    std::vector<char*> pointers;
    for (std::string& word : copies) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const File input("/dev/null", O_RDONLY);
    const File output(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC);
    std::array<int, 2> failure{};
    if (pipe2(failure.data(), O_CLOEXEC) != 0)
        throw Error(words[0], fmt::format("cannot be started ({})", std::strerror(errno)),
                    "close other programs");
    const pid_t parent = getpid();
    const pid_t process = fork();
    if (process == 0) become(pointers.data(), input.number(), output.number(), failure[1], parent);
    const int fork_error = errno;
    close(failure[1]);
    int error = 0;
    ssize_t got = 0;
    while (process > 0 && (got = read(failure[0], &error, sizeof error)) < 0 && errno == EINTR) {
    }
    close(failure[0]);
    if (process < 0 || got > 0) {
        if (process > 0) waitpid(process, nullptr, 0);
        throw Error(
            words[0],
            fmt::format("cannot be started ({})", std::strerror(process < 0 ? fork_error : error)),
            "name a program by its path, or one along PATH; there is no shell in between");
    }
    return wait_for(process, seconds);
}

std::vector<std::string> split_words(const std::string& command) {
    std::vector<std::string> words;
    bool within = false; // a word, which may be empty: ''
    char quote = 0;
    for (std::size_t i = 0; i < command.size(); ++i) {
        const char c = command[i];
        if (quote == 0 && (c == ' ' || c == '\t' || c == '\n')) {
            within = false;
            continue;
        }
        if (!within) words.emplace_back();
        within = true;
        if (c == quote) {
            quote = 0;
        } else if (quote == 0 && (c == '\'' || c == '"')) {
            quote = c;
        } else if (c == '\\' && quote != '\'' && i + 1 < command.size()) {
            words.back() += command[++i];
        } else {
            words.back() += c;
        }
    }
    if (quote != 0) throw std::invalid_argument(fmt::format("a quote, {}, does not end", quote));
    return words;
}

} // namespace shadowproof
