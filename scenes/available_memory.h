// How much more memory this process can get on this machine.
#pragma once

#include "scenes/memory_budget.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

namespace shadowproof {

/// Bytes, the least of the following; what cannot be read is skipped:
/// - what the kernel reports as available (MemAvailable, proc(5));
/// - for each control group that holds this process, and each group around it: its limit less what
///   the group holds and could not give back (cgroup 2: memory.max, memory.current, inactive_file;
///   cgroup 1: the same under other names);
/// - this process's limits of address space and data (RLIMIT_AS, RLIMIT_DATA) less what it has
///   mapped.
/// `root` holds /proc and /sys.
std::uint64_t available_memory(const std::filesystem::path& root = "/");

/// Three quarters of the available memory; the rest is for what is not counted and for other
/// processes.
MemoryBudget default_memory_budget(const std::filesystem::path& root = "/");

/// A number of bytes, such as "512MB", "1.5GiB", "2e9" or "2GB": a number, and one of B, kB, MB,
/// GB, TB (powers of 1000), KiB, MiB, GiB, TiB (of 1024) or their first letters (of 1000), in
/// either case. Empty where the text is no such number, and below one byte or above 2^63.
std::optional<std::uint64_t> parse_bytes(std::string_view text);

} // namespace shadowproof
