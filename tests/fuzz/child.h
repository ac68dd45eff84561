// A program run under limits.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace shadowproof::fuzz {

struct ChildLimits {
    unsigned processor_seconds = 20;
    unsigned wall_seconds = 120;
    std::uint64_t address_bytes = 2'000'000'000;
};

struct ChildResult {
    int exit_code = -1; ///< -1: it ended by a signal
    int signal = 0;
    bool timed_out = false;        ///< by the wall's clock, and was killed
    double processor_seconds = 0;  ///< its own and its children's
    std::uint64_t most_memory = 0; ///< bytes resident
};

/// Standard output and standard error go to files. Throws std::runtime_error where no process can
/// be made.
ChildResult run_child(const std::vector<std::string>& command, const std::filesystem::path& output,
                      const std::filesystem::path& error, const ChildLimits& limits);

} // namespace shadowproof::fuzz
