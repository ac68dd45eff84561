#include "compare/output/followed.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <string>
#include <system_error>

namespace shadowproof {

namespace {

namespace fs = std::filesystem;

constexpr int most_links = 40; ///< as the kernel follows (path_resolution(7))

/// The folder of `path` without links, and its own name.
fs::path with_followed_folder(const fs::path& path) {
    fs::path absolute = fs::absolute(path);
    if (!absolute.has_filename()) absolute = absolute.parent_path();
    if (absolute == absolute.root_path()) return absolute;
    if (absolute.filename() == "." || absolute.filename() == "..")
        return fs::weakly_canonical(absolute);
    return fs::weakly_canonical(absolute.parent_path()) / absolute.filename();
}

std::optional<int> number_in(const fs::path& path) {
    if (path.parent_path() != fmt::format("/proc/{}/fd", getpid())) return std::nullopt;
    const std::string name = path.filename().string();
    int number = -1;
    const auto parsed = std::from_chars(name.data(), name.data() + name.size(), number);
    if (parsed.ec != std::errc() || parsed.ptr != name.data() + name.size()) return std::nullopt;
    return number;
}

/// Follows links until `stop` holds for a path, or there are none.
template <class Stop>
fs::path follow(const fs::path& path, const Stop& stop) {
    fs::path at = with_followed_folder(path);
    for (int i = 0; !stop(at) && fs::is_symlink(fs::symlink_status(at)); ++i) {
        if (i == most_links) throw std::system_error(ELOOP, std::generic_category());
        at = with_followed_folder(at.parent_path() / fs::read_symlink(at));
    }
    return at;
}

} // namespace

fs::path followed(const fs::path& path) {
    return follow(path, [](const fs::path&) { return false; });
}

std::optional<int> open_descriptor(const fs::path& path) {
    return number_in(follow(path, [](const fs::path& at) { return number_in(at).has_value(); }));
}

} // namespace shadowproof
