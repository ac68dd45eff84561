// Runs work in a child process: a crash of this program, the driver or a library ends the child
// alone, and the parent can report it and go on.
#pragma once

#include <sys/types.h>

#include <functional>
#include <optional>
#include <string>

namespace shadowproof {

/// How a child ended: its work returned a code; or a signal ended it; or a library did, by exit().
struct ChildEnd {
    std::optional<int> code; ///< that its work returned
    int signal = 0;          ///< 0: none
    int library_code = 0;    ///< given to exit(), where there is neither of the two
};

/// "was ended by signal 11 (Segmentation fault)", "ended with code 3", "was ended by a library,
/// with code 127, as where memory runs out"
std::string words_of(const ChildEnd& end);

/// A child process with a pipe to its parent. It is killed if its parent ends first, or if this is
/// destroyed before wait(); so are its own children, which hold the pipe too. One at a time.
class ChildProcess {
public:
    /// Forks. The child calls `work` with the writing end of the pipe and ends with the code that
    /// it returns, 0 to 15; `work` must not throw. Threads of the parent are not in the child, so
    /// neither Embree nor OpenGL may have been used before. Throws Error if no process can be made.
    explicit ChildProcess(const std::function<int(int pipe)>& work);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// The reading end of the pipe; at end of file when the child has ended.
    int pipe() const { return pipe_; }
    void kill();
    ChildEnd wait();

private:
    pid_t process_ = -1;
    int pipe_ = -1;
};

} // namespace shadowproof
