#include "scenes/load/compressed/isolated.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <new>

namespace shadowproof {

namespace {

/// Where an allocation fails, AddressSanitizer allocates more to report it, and then waits forever
/// for a lock of its own.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool limits_addresses = false;
#else
constexpr bool limits_addresses = true;
#endif

/// Seconds after which a child is ended that takes no processor time: far more than what it may
/// take of that would last on a busy machine.
unsigned longest_wait(std::uint64_t processor_seconds) {
    return static_cast<unsigned>(std::min<std::uint64_t>(60 + 20 * processor_seconds, 86'400));
}

enum ChildCode : int { code_finished = 0, code_out_of_memory = 80, code_threw = 81 };

/// Never above what the process may have anyway.
void lower_limit(__rlimit_resource resource, std::uint64_t value) {
    rlimit limit{};
    if (::getrlimit(resource, &limit) != 0) return;
    limit.rlim_cur = std::min<rlim_t>(limit.rlim_cur, value);
    ::setrlimit(resource, &limit);
}

/// Bytes of addresses that this process has mapped. A sanitizer's shadow memory counts.
std::uint64_t mapped_bytes() {
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

/// The parent's handlers would report a crash that is none, or clean up for it.
void take_default_signals() {
    for (const int signal :
         {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU, SIGALRM, SIGINT, SIGTERM, SIGHUP})
        ::signal(signal, SIG_DFL);
}

void silence() {
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere < 0) return;
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
}

[[noreturn]] void run_child(const IsolationLimits& limits, pid_t parent, std::uint64_t mapped,
                            const std::function<void()>& work) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(code_threw); // it has ended in the meantime
    take_default_signals();
    silence();
    lower_limit(RLIMIT_CORE, 0);
    lower_limit(RLIMIT_CPU, limits.seconds);
    if (limits_addresses) lower_limit(RLIMIT_AS, mapped + limits.bytes);
    ::alarm(longest_wait(limits.seconds));
    int code = code_finished;
    try {
        work();
    } catch (const std::bad_alloc&) {
        code = code_out_of_memory;
    } catch (...) {
        code = code_threw;
    }
    ::_exit(code);
}

IsolatedEnd end_of(int status) {
    if (WIFSIGNALED(status))
        return WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGALRM ? IsolatedEnd::out_of_time
                                                                          : IsolatedEnd::crashed;
    switch (WEXITSTATUS(status)) {
    case code_finished:
        return IsolatedEnd::finished;
    case code_out_of_memory:
        return IsolatedEnd::out_of_memory;
    default:
        return IsolatedEnd::threw;
    }
}

} // namespace

SharedBytes::SharedBytes(std::size_t size) : size_(size) {
    void* const mapped = ::mmap(nullptr, std::max<std::size_t>(size, 1), PROT_READ | PROT_WRITE,
                                MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (mapped == MAP_FAILED) throw std::bad_alloc();
    first_ = static_cast<unsigned char*>(mapped);
}

SharedBytes::~SharedBytes() {
    ::munmap(first_, std::max<std::size_t>(size_, 1));
}

IsolatedEnd run_isolated(const IsolationLimits& allowed, const std::function<void()>& work) {
    const std::uint64_t mapped = mapped_bytes();
    const pid_t parent = ::getpid();
    const pid_t child = ::fork();
    if (child < 0) return IsolatedEnd::no_process;
    if (child == 0) run_child(allowed, parent, mapped, work);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0)
        if (errno != EINTR) return IsolatedEnd::crashed;
    return end_of(status);
}

} // namespace shadowproof
