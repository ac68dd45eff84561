#include "compare/output/journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <sstream>
#include <system_error>

namespace shadowproof {

namespace {

namespace fs = std::filesystem;

/// The kinds of lines, one letter each.
enum Kind : char { of_folder = 'f', of_begun = 'b', of_complete = 'c', of_kept = 'k' };

void append(const Descriptor& file, Kind kind, const std::string& rest) {
    write_all(file, fmt::format("\n{} {}\n", static_cast<char>(kind), rest));
}

/// Reads line by line; a line without an end was truncated.
void take(JournalRecord& record, const std::string& line) {
    if (line.size() < 3) return;
    std::istringstream words(line.substr(2));
    const std::string name = line.substr(2);
    FolderIdentity folder;
    Fingerprint fingerprint;
    switch (line[0]) {
    case of_folder:
        if (words >> folder.device >> folder.inode) record.folder = folder;
        break;
    case of_begun: {
        std::string begun;
        if (words >> fingerprint.size >> fingerprint.xxh3 && std::getline(words.ignore(), begun) &&
            is_name_below(begun))
            record.begun.insert_or_assign(begun, fingerprint);
        break;
    }
    case of_complete:
        if (const auto begun = record.begun.find(name); begun != record.begun.end())
            record.written.insert(*begun);
        break;
    case of_kept:
        record.kept.insert(name);
        break;
    default:
        break;
    }
}

} // namespace

FolderIdentity identity_of(const fs::path& folder) {
    struct stat status {};
    if (::lstat(folder.c_str(), &status) != 0) throw_errno();
    return {status.st_dev, status.st_ino};
}

Journal::Journal(const fs::path& file, const FolderIdentity& folder)
    : file_(open_file(file, O_CREAT | O_EXCL | O_WRONLY | O_APPEND)) {
    append(file_, of_folder, fmt::format("{} {}", folder.device, folder.inode));
}

void Journal::begin(const std::string& name, const Fingerprint& fingerprint) const {
    append(file_, of_begun, fmt::format("{} {} {}", fingerprint.size, fingerprint.xxh3, name));
}

void Journal::complete(const std::string& name) const {
    append(file_, of_complete, name);
}

void Journal::keep(const std::string& name) const {
    append(file_, of_kept, name);
}

JournalRecord read_journal(const fs::path& file) {
    JournalRecord record;
    std::string text;
    try {
        read_pieces(file, [&](std::string_view piece) { text += piece; });
    } catch (const std::system_error& error) {
        if (error.code().value() != ENOENT) throw;
    }
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line) && !stream.eof();) take(record, line);
    return record;
}

} // namespace shadowproof
