// Links, followed to what they stand for.
#pragma once

#include <filesystem>
#include <optional>

namespace shadowproof {

/// Where `path` leads: absolute, without links, "." and "..", whether anything is there or not. Of
/// a link to nothing it is what the link names: who creates that makes the link good. A slash at
/// the end changes nothing. Throws std::system_error, for example where links run in a circle.
std::filesystem::path followed(const std::filesystem::path& path);

/// The number of an open file of this process that `path` names, as /dev/stdout, /dev/fd/3 and
/// /proc/self/fd/3 do.
std::optional<int> open_descriptor(const std::filesystem::path& path);

} // namespace shadowproof
