// How much memory this process can still get on this machine.
#pragma once

#include "scenes/memory_budget.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

namespace shadowproof {

/// Bytes, the least of: what the kernel calls available (MemAvailable, proc(5)); of each control
/// group that this process is in and of those around it, the limit less what the group holds and
/// could not give back (cgroup 2: memory.max, memory.current, inactive_file; cgroup 1: the same by
/// other names); and this process's own limits of address space and data (RLIMIT_AS, RLIMIT_DATA)
/// less what it has mapped. What cannot be read does not count. `root` holds /proc and /sys.
std::uint64_t available_memory(const std::filesystem::path& root = "/");

/// Three quarters of it: the rest is for what is not counted, and for others.
MemoryBudget default_memory_budget(const std::filesystem::path& root = "/");

/// "512MB", "1.5GiB", "2e9", "2GB": a number, and one of B, kB, MB, GB, TB (powers of 1000), KiB,
/// MiB, GiB, TiB (of 1024) or their first letters (of 1000), in either case. Nothing where it is
/// none, or below one byte, or above 2^63.
std::optional<std::uint64_t> parse_bytes(std::string_view text);

} // namespace shadowproof
