#include "compare/output/unwritable.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <string>

namespace shadowproof {

namespace {

/// The remedy for `reason`; `otherwise` if it has none of its own.
std::string remedy_for(int reason, const char* otherwise) {
    switch (reason) {
    case ENOSPC:
        return "free some space, or name another place";
    case EDQUOT:
        return "free some of your quota, or name another place";
    case EFBIG:
        return "raise the limit on the size of files (ulimit -f), or name another place";
    case EIO:
        return "look after the disk, or name another place";
    case EMFILE:
    case ENFILE:
        return "raise the limit on open files (ulimit -n)";
    case ENXIO:
        return "start its reader, or name another file";
    case EPIPE:
        return "keep its reader running to the end";
    case ENAMETOOLONG:
        return "give a shorter name";
    case ELOOP:
        return "repair the links that lead to it";
    default:
        return otherwise;
    }
}

} // namespace

Error unwritable(const std::filesystem::path& file, int reason) {
    const std::string why =
        reason == ENXIO ? "nobody reads from the other end" : std::strerror(reason);
    return {file.string(), fmt::format("cannot be written ({})", why),
            remedy_for(reason, "name a file in a folder that exists and is writable")};
}

Error unwritable_report(const std::filesystem::path& folder, int reason) {
    return {folder.string(),
            fmt::format("the report cannot be written ({})", std::strerror(reason)),
            remedy_for(reason, "name a folder that is writable with --out")};
}

} // namespace shadowproof
