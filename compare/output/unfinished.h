// Files that are being written: they are removed if the work fails or a signal ends the program
// before they are complete and at their place.
#pragma once

#include <sys/types.h>

#include <functional>
#include <list>
#include <mutex>

namespace shadowproof {

/// Guards something unfinished. If this is destroyed before done(), or a signal ends the program,
/// it calls `remove`, which must not throw. Child processes that inherit the guard never call it.
class Unfinished {
public:
    explicit Unfinished(std::function<void()> remove);
    ~Unfinished();
    Unfinished(const Unfinished&) = delete;
    Unfinished& operator=(const Unfinished&) = delete;

    /// To be called when it is finished: `remove` is not called any more.
    void done();

private:
    pid_t owner_;
    std::list<std::function<void()>>::iterator place_;
    bool done_ = false;
};

/// The lock to hold while writing anything unfinished, so that nothing is added during a removal. A
/// thread may lock it repeatedly.
std::unique_lock<std::recursive_mutex> hold_unfinished();

/// Removes everything unfinished, and keeps the lock: from then on hold_unfinished() blocks all
/// other threads. To be called only by the thread that ends the process.
void remove_unfinished();

} // namespace shadowproof
