#include "compare/command/guard.h"

#include "compare/command/process/child_process.h"
#include "compare/command/process/console.h"
#include "compare/command/process/exit_code.h"
#include "compare/command/process/signals.h"
#include "compare/command/process/standard_output.h"
#include "compare/memory.h"
#include "compare/output/unfinished.h"
#include "compare/report/report.h"
#include "scenes/error.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <limits>
#include <new>
#include <optional>
#include <string_view>

namespace shadowproof {

namespace {

/// The writer of a report first removes what a dead process left of it.
void remove_leftovers(const std::string& report) {
    try {
        ReportFolder{report};
    } catch (const std::exception&) {
        // Another run writes there by now, or the place is gone: there is nothing to report.
    }
}

using Clock = std::chrono::steady_clock;

Clock::duration seconds_long(double seconds) {
    return std::chrono::ceil<Clock::duration>(std::chrono::duration<double>(seconds));
}

/// Seconds without a message after which a line says what is being done. Tests have less time.
double longest_silence() {
    const char* text = std::getenv("SHADOWPROOF_SILENCE");
    constexpr double minute = 60;
    return text != nullptr ? parse_number(text).value_or(minute) : minute;
}

/// What a child says that it is doing, a line each (Console::progress), and since when.
class Watch {
public:
    explicit Watch(int pipe) : pipe_(pipe) {}

    /// Returns true when the child has ended, and false at `until`, if that comes first.
    bool follow(std::optional<Clock::time_point> until) {
        while (true) {
            Clock::time_point next = heard_at_ + speaks_after_;
            if (until) next = std::min(next, *until);
            if (is_readable(next) && !read_some()) return true;
            if (until && Clock::now() >= *until) return false;
            if (Clock::now() >= heard_at_ + speaks_after_) speak_up();
        }
    }

private:
    int pipe_;
    std::string unfinished_{}; ///< the beginning of a line
    std::string doing_{};      ///< empty: it has not said anything
    Clock::time_point heard_at_ = Clock::now();
    const Clock::duration silence_ = seconds_long(longest_silence());
    Clock::duration speaks_after_ = silence_;

    bool is_readable(Clock::time_point until) const {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now());
        // poll() takes an int: a long wait is split.
        const auto wait =
            std::clamp<std::int64_t>(left.count(), 0, std::numeric_limits<int>::max());
        pollfd pipe{.fd = pipe_, .events = POLLIN, .revents = 0};
        return poll(&pipe, 1, static_cast<int>(wait)) > 0;
    }

    /// False at the end.
    bool read_some() {
        std::array<char, 4096> bytes{};
        const ssize_t got = read(pipe_, bytes.data(), bytes.size());
        if (got < 0) return errno == EINTR;
        if (got == 0) return false;
        unfinished_.append(bytes.data(), static_cast<std::size_t>(got));
        const std::size_t end = unfinished_.rfind('\n');
        if (end == std::string::npos) return true;
        const std::string_view whole = std::string_view(unfinished_).substr(0, end);
        const std::size_t before = whole.rfind('\n');
        doing_ = whole.substr(before == std::string_view::npos ? 0 : before + 1);
        unfinished_.erase(0, end + 1);
        heard_at_ = Clock::now();
        speaks_after_ = silence_;
        return true;
    }

    void speak_up() {
        const auto taken =
            std::chrono::duration_cast<std::chrono::seconds>(Clock::now() - heard_at_).count();
        speaks_after_ *= 2;
        if (doing_.empty()) return;
        Console console(false);
        console.take_over();
        console.line(fmt::format("{}: at it for {} s", doing_, taken));
    }
};

/// Does the work in a child process, to its end.
ChildEnd watched(const WatchedWork& work) {
    ChildProcess child([&](int pipe) { return run_to_exit_code([&] { return work(pipe); }); });
    Watch(child.pipe()).follow(std::nullopt);
    return child.wait();
}

constexpr const char* nothing_written = "nothing was written; report this with the command";

/// The exit code of a child that has ended, with a message if it did not end by itself; `left`:
/// what there is of its work then.
int code_of(const ChildEnd& end, const std::string& left = nothing_written) {
    if (end.code) return *end.code;
    complain(fmt::format("the process that did the work {}; {}", words_of(end), left));
    return exit_could_not;
}

} // namespace

int run_to_exit_code(const Work& work) noexcept {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        complain(out_of_memory);
    } catch (const std::filesystem::filesystem_error& error) {
        complain(Error(error.path1().string(),
                       fmt::format("cannot be looked at ({})", error.code().message()),
                       "check its permissions, and the disk that it is on")
                     .what());
    } catch (const std::exception& error) {
        complain(error.what());
    }
    return exit_could_not;
}

int guarded(const WatchedWork& work, const std::string& report) {
    Unfinished left_behind([&] {
        if (!report.empty()) remove_leftovers(report);
    });
    const ChildEnd end = watched(work);
    if (end.code) left_behind.done();
    return code_of(end);
}

int guarded_resumable(const WatchedWork& work, const std::string& report) {
    const std::string words = "the same command goes on with what is done of " + report;
    leave_unfinished(words);
    return code_of(watched(work), words);
}

int guarded_within(double seconds, const std::string& what, const WatchedWork& work) {
    ChildProcess child([&](int pipe) { return run_to_exit_code([&] { return work(pipe); }); });
    std::optional<Clock::time_point> until;
    if (seconds > 0) until = Clock::now() + seconds_long(seconds);
    if (Watch(child.pipe()).follow(until)) return code_of(child.wait());
    child.kill();
    child.wait();
    complain(Error(what, fmt::format("took longer than --timeout {}", seconds),
                   "give it more seconds (0: any number), a smaller --size, or a simpler scene")
                 .what());
    return exit_could_not;
}

} // namespace shadowproof
