#include "scenes/load/common/file_bytes.h"

#include "scenes/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

namespace shadowproof {

FileBytes read_bytes(const std::filesystem::path& file, const Place& place,
                     const MemoryAccount& memory, std::optional<std::uint64_t> first) {
    // A place that is the whole file has named it already.
    const std::string named =
        place.where() == file.string() ? "" : fmt::format("\"{}\" ", file.string());
    std::error_code failure;
    const auto status = std::filesystem::status(file, failure);
    if (status.type() == std::filesystem::file_type::not_found)
        place.refuse(named + "does not exist", "check the path");
    if (failure)
        place.refuse(fmt::format("{}cannot be reached ({})", named, failure.message()),
                     "check the path and its permissions");
    if (!std::filesystem::is_regular_file(status))
        place.refuse(named + "is not a regular file", "name a file");
    const std::uint64_t size = std::filesystem::file_size(file, failure);
    if (failure || first.value_or(size) > limits.bytes)
        place.refuse(fmt::format("{}has more than {} bytes", named, limits.bytes),
                     "split the asset");
    const std::uint64_t wanted = std::min(size, first.value_or(size));
    memory.require({wanted, place.where(), "its bytes", "split the asset"});
    FileBytes bytes(wanted);
    std::ifstream stream(file, std::ios::binary);
    if (!stream.read(reinterpret_cast<char*>(bytes.data()),
                     static_cast<std::streamsize>(bytes.size())))
        place.refuse(named + "cannot be read", "check its permissions");
    return bytes;
}

} // namespace shadowproof
