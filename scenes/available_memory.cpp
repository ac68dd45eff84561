#include "scenes/available_memory.h"

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace shadowproof {

namespace {

using std::filesystem::path;

constexpr std::uint64_t no_limit = MemoryBudget::no_limit;
constexpr std::uint64_t kibibyte = 1024;

/// The number at the beginning of a file; nothing where there is none, as in "max".
std::optional<std::uint64_t> number_in(const path& file) {
    std::ifstream stream(file);
    std::uint64_t number = 0;
    if (stream >> number) return number;
    return std::nullopt;
}

/// The number behind `name` at the beginning of a line.
std::optional<std::uint64_t> number_named(const path& file, const std::string& name) {
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) {
        if (!line.starts_with(name)) continue;
        const std::size_t digit = line.find_first_of("0123456789", name.size());
        std::uint64_t number = 0;
        if (digit != std::string::npos &&
            std::from_chars(line.data() + digit, line.data() + line.size(), number).ec ==
                std::errc())
            return number;
    }
    return std::nullopt;
}

std::uint64_t less(std::uint64_t limit, std::uint64_t used) {
    return limit > used ? limit - used : 0;
}

/// The files of one kind of control group.
struct GroupFiles {
    const char* limit;
    const char* used;
    const char* reclaimable; ///< in memory.stat: pages of files that are not in use
};
constexpr GroupFiles version_2{"memory.max", "memory.current", "inactive_file "};
constexpr GroupFiles version_1{"memory.limit_in_bytes", "memory.usage_in_bytes",
                               "total_inactive_file "};

/// Bytes left in the group whose folder this is.
std::uint64_t left_in_group(const path& folder, const GroupFiles& files) {
    const auto limit = number_in(folder / files.limit);
    if (!limit) return no_limit;
    const std::uint64_t used = number_in(folder / files.used).value_or(0);
    const std::uint64_t back = number_named(folder / "memory.stat", files.reclaimable).value_or(0);
    return less(*limit, less(used, back));
}

/// Bytes left in the group and in all groups around it, the least. A container sees its own group
/// as the mount's root, though /proc/self/cgroup may give a longer path: what does not exist has no
/// limit.
std::uint64_t left_in_groups(const path& mount, path group, const GroupFiles& files) {
    std::uint64_t left = left_in_group(mount, files);
    for (; group.has_relative_path(); group = group.parent_path())
        left = std::min(left, left_in_group(mount / group.relative_path(), files));
    return left;
}

/// Lines of /proc/self/cgroup: "0::/a/b" (version 2), "7:cpu,memory:/a/b" (version 1).
std::uint64_t left_in_all_groups(const path& root) {
    const path mount = root / "sys/fs/cgroup";
    std::uint64_t left = std::min(left_in_groups(mount, "/", version_2),
                                  left_in_groups(mount / "memory", "/", version_1));
    std::ifstream stream(root / "proc/self/cgroup");
    for (std::string line; std::getline(stream, line);) {
        const std::size_t first = line.find(':');
        const std::size_t second = line.find(':', first + 1);
        if (first == std::string::npos || second == std::string::npos) continue;
        const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
        const path group = line.substr(second + 1);
        if (controllers == ",,") {
            left = std::min(left, left_in_groups(mount, group, version_2));
            left = std::min(left, left_in_groups(mount / "unified", group, version_2));
        }
        if (controllers.find(",memory,") != std::string::npos)
            left = std::min(left, left_in_groups(mount / "memory", group, version_1));
    }
    return left;
}

/// Bytes left of a limit of this process; `mapped` names what counts towards it in
/// /proc/self/status.
std::uint64_t left_of_limit(const path& root, int resource, const char* mapped) {
    struct rlimit limit {};
    if (getrlimit(static_cast<__rlimit_resource_t>(resource), &limit) != 0 ||
        limit.rlim_cur == RLIM_INFINITY)
        return no_limit;
    return less(limit.rlim_cur,
                number_named(root / "proc/self/status", mapped).value_or(0) * kibibyte);
}

} // namespace

std::uint64_t available_memory(const path& root) {
    const auto machine = number_named(root / "proc/meminfo", "MemAvailable:");
    return std::min({machine ? *machine * kibibyte : no_limit, left_in_all_groups(root),
                     left_of_limit(root, RLIMIT_AS, "VmSize:"),
                     left_of_limit(root, RLIMIT_DATA, "VmData:")});
}

MemoryBudget default_memory_budget(const path& root) {
    const std::uint64_t available = available_memory(root);
    if (available == no_limit) return {};
    return {available / 4 * 3, "three quarters of what is available"};
}

std::optional<std::uint64_t> parse_bytes(std::string_view text) {
    double number = 0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), number);
    if (parsed.ec != std::errc()) return std::nullopt;
    std::string unit(parsed.ptr, text.data() + text.size());
    for (char& c : unit) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (unit.ends_with("b")) unit.pop_back();
    constexpr std::array<std::pair<std::string_view, double>, 9> units{{{"", 1},
                                                                        {"k", 1e3},
                                                                        {"m", 1e6},
                                                                        {"g", 1e9},
                                                                        {"t", 1e12},
                                                                        {"ki", 0x1p10},
                                                                        {"mi", 0x1p20},
                                                                        {"gi", 0x1p30},
                                                                        {"ti", 0x1p40}}};
    const auto* const known = std::find_if(units.begin(), units.end(),
                                           [&](const auto& one) { return one.first == unit; });
    if (known == units.end()) return std::nullopt;
    const double bytes = number * known->second;
    if (!(bytes >= 1) || !(bytes < 0x1p63)) return std::nullopt;
    return static_cast<std::uint64_t>(bytes);
}

} // namespace shadowproof
