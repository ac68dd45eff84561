#include "compare/command/guard.h"

#include "compare/command/child_process.h"
#include "compare/command/standard_output.h"
#include "compare/memory.h"
#include "compare/output/unfinished.h"
#include "compare/report.h"

#include <exception>
#include <new>

namespace shadowproof {

namespace {

/// Who writes a report removes first what a dead process left of it.
void remove_leftovers(const std::string& report) {
    try {
        ReportFolder{report};
    } catch (const std::exception&) {
        // Another run writes there by now, or the place is gone: nothing is left to be said.
    }
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
    if (end.code) {
        left_behind.done();
        return *end.code;
    }
    complain("the process that did the work " + words_of(end) +
             "; nothing was written; report this with the command");
    return exit_could_not;
}

} // namespace shadowproof
