#include "compare/command/guard.h"

#include "compare/command/child_process.h"
#include "compare/command/standard_output.h"
#include "compare/memory.h"
#include "compare/output/unfinished.h"
#include "compare/report/report.h"
#include "scenes/error.h"

#include <fmt/format.h>

#include <exception>
#include <new>

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

/// The exit code of a child that has ended, with a message if it did not end by itself.
int code_of(const ChildEnd& end) {
    if (end.code) return *end.code;
    complain("the process that did the work " + words_of(end) +
             "; nothing was written; report this with the command");
    return exit_could_not;
}

} // namespace

int run_to_exit_code(const Work& work) noexcept {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        complain(out_of_memory);
    } catch (const std::exception& error) {
        complain(error.what());
    }
    return exit_could_not;
}

int guarded(const Work& work, const std::string& report) {
    Unfinished left_behind([&] {
        if (!report.empty()) remove_leftovers(report);
    });
    ChildProcess child([&](int /*pipe*/) { return run_to_exit_code(work); });
    const ChildEnd end = child.wait();
    if (end.code) left_behind.done();
    return code_of(end);
}

int guarded_within(double seconds, const std::string& what, const Work& work) {
    ChildProcess child([&](int /*pipe*/) { return run_to_exit_code(work); });
    if (seconds == 0 || child.ends_within(seconds)) return code_of(child.wait());
    child.kill();
    child.wait();
    complain(Error(what, fmt::format("took longer than --timeout {}", seconds),
                   "give it more seconds (0: any number), a smaller --size, or a simpler scene")
                 .what());
    return exit_could_not;
}

} // namespace shadowproof
