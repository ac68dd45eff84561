// Inputs on which a promise was broken without a crash, by kind.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace shadowproof::fuzz {

/// A target's input.
using Input = std::span<const std::uint8_t>;

/// Aborts; but where SHADOWPROOF_FUZZ_FINDINGS names a folder, keeps there the smallest inputs of
/// each kind as KIND.0, KIND.1 and so on, and returns.
void report_finding(const std::string& kind, Input input);

/// The same where there is something wrong with an Error's text (fault_of_message). `target`: the
/// kind begins with it.
void check_message(const std::string& message, const std::string& where, const char* target,
                   Input input);

/// Of this process and all its threads, so that a machine that does other work is no finding.
double processor_seconds();

/// While fuzzing, reports "TARGET-slow" where an input has taken more than `most_seconds` of them.
/// Replays of kept inputs are tests, which time nothing.
class TimePromise {
public:
    TimePromise(const char* target, Input input, double most_seconds);
    ~TimePromise();
    TimePromise(const TimePromise&) = delete;
    TimePromise& operator=(const TimePromise&) = delete;

private:
    const char* target_;
    Input input_;
    double most_seconds_;
    double begin_;
};

} // namespace shadowproof::fuzz
