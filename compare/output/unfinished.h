// What is being written and is not at its place yet, so that whoever interrupts the program finds
// none of it.
#pragma once

#include <sys/types.h>

#include <functional>
#include <list>
#include <mutex>

namespace shadowproof {

/// Something unfinished. When this goes, or when a signal ends the program, `remove` is called,
/// which must not throw: in the process that made this alone, whatever children it has.
class Unfinished {
public:
    explicit Unfinished(std::function<void()> remove);
    ~Unfinished();
    Unfinished(const Unfinished&) = delete;
    Unfinished& operator=(const Unfinished&) = delete;

    /// It is finished: nothing is left to be removed.
    void done();

private:
    pid_t owner_;
    std::list<std::function<void()>>::iterator place_;
    bool done_ = false;
};

/// Held while anything unfinished is written, so that it cannot grow behind the one who removes it.
/// One thread may hold several.
std::unique_lock<std::recursive_mutex> hold_unfinished();

/// Removes whatever is unfinished. From then on nobody can hold_unfinished(): to be called where
/// the process ends, by the thread that ends it.
void remove_unfinished();

} // namespace shadowproof
