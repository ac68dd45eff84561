#include "compare/output/journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <string_view>
#include <system_error>
#include <utility>

namespace shadowproof {

namespace {

namespace fs = std::filesystem;

/// The kinds of lines, one letter each.
enum Kind : char {
    of_folder = 'f',
    of_begun = 'b',
    of_complete = 'c',
    of_kept = 'k',
    of_dropped = 'd'
};

void append(const Descriptor& file, Kind kind, const std::string& rest) {
    write_all(file, fmt::format("\n{} {}\n", static_cast<char>(kind), rest));
}

// Streams would end where memory runs out, without a word, and what is left would count as all.

/// Takes the text before the next separator, and that; what is left if there is none.
std::string_view taken(std::string_view& text, char separator) {
    const std::size_t end = std::min(text.find(separator), text.size());
    const std::string_view part = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return part;
}

template <class Number>
bool is_number(std::string_view text, Number& number) {
    const auto [end, error] = std::from_chars(text.begin(), text.end(), number);
    return error == std::errc() && end == text.end();
}

void take(JournalRecord& record, std::string_view line) {
    if (line.size() < 3) return;
    const std::string name(line.substr(2));
    std::string_view rest = name;
    switch (line[0]) {
    case of_folder: {
        FolderIdentity folder;
        if (is_number(taken(rest, ' '), folder.device) && is_number(taken(rest, ' '), folder.inode))
            record.folder = folder;
        break;
    }
    case of_begun: {
        Fingerprint fingerprint;
        if (!is_number(taken(rest, ' '), fingerprint.size)) break;
        fingerprint.xxh3 = taken(rest, ' ');
        if (is_name_below(rest))
            record.begun.insert_or_assign(std::string(rest), std::move(fingerprint));
        break;
    }
    case of_complete:
        if (const auto begun = record.begun.find(name); begun != record.begun.end())
            record.written.insert(*begun);
        break;
    case of_dropped:
        record.begun.erase(name);
        record.written.erase(name);
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

Journal::Journal(const fs::path& file) : file_(open_file(file, O_WRONLY | O_APPEND | O_NOFOLLOW)) {}

void Journal::begin(const std::string& name, const Fingerprint& fingerprint) const {
    append(file_, of_begun, fmt::format("{} {} {}", fingerprint.size, fingerprint.xxh3, name));
}

void Journal::complete(const std::string& name) const {
    append(file_, of_complete, name);
}

void Journal::drop(const std::string& name) const {
    append(file_, of_dropped, name);
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
    // A line without an end was truncated.
    std::string_view left(text);
    left = left.substr(0, left.rfind('\n') + 1);
    while (!left.empty()) take(record, taken(left, '\n'));
    return record;
}

} // namespace shadowproof
