#include "compare/output/unfinished.h"

#include <unistd.h>

#include <utility>

namespace shadowproof {

namespace {

/// Global, as signals are sent to the process. Never destroyed: the thread that waits for signals
/// may outlive main().
struct Registry {
    std::recursive_mutex guard;
    std::list<std::function<void()>> removals;
};
Registry& registry() {
    static auto* const the_one = new Registry;
    return *the_one;
}

} // namespace

Unfinished::Unfinished(std::function<void()> remove) : owner_(getpid()) {
    const auto lock = hold_unfinished();
    auto& removals = registry().removals;
    place_ = removals.insert(removals.end(), [owner = owner_, remove = std::move(remove)] {
        if (getpid() == owner) remove();
    });
}

Unfinished::~Unfinished() {
    const auto lock = hold_unfinished();
    if (done_) return;
    (*place_)();
    registry().removals.erase(place_);
}

void Unfinished::done() {
    const auto lock = hold_unfinished();
    if (!done_) registry().removals.erase(place_);
    done_ = true;
}

std::unique_lock<std::recursive_mutex> hold_unfinished() {
    return std::unique_lock(registry().guard);
}

void remove_unfinished() {
    registry().guard.lock(); // never unlocked: no thread writes any more
    for (const auto& remove : registry().removals) remove();
}

} // namespace shadowproof
