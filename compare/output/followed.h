// Resolves symbolic links.
#pragma once

#include <filesystem>
#include <optional>

namespace shadowproof {

/// Where `path` leads: absolute, without links, "." and "..". Nothing need exist there: a dangling
/// link leads to the path that it names. A slash at the end changes nothing. Throws
/// std::system_error, for example for a loop of links.
std::filesystem::path followed(const std::filesystem::path& path);

/// The number of an open file of this process that `path` names, as /dev/stdout, /dev/fd/3 and
/// /proc/self/fd/3 do.
std::optional<int> open_descriptor(const std::filesystem::path& path);

} // namespace shadowproof
