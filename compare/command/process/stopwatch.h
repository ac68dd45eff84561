// Wall-clock time of a piece of work.
#pragma once

#include <chrono>
#include <optional>

namespace shadowproof {

class Stopwatch {
public:
    double milliseconds() const {
        return std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
    }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

/// Since this process was started, including the loading of its libraries. Linux notes the start in
/// clock ticks since boot (proc(5), field 22), so to within 10 ms. None if /proc is not mounted.
std::optional<double> milliseconds_since_start_of_process();

} // namespace shadowproof
