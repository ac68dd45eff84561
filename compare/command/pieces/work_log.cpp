#include "compare/command/pieces/work_log.h"

#include "compare/output/manifest.h"
#include "compare/output/unwritable.h"
#include "scenes/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <optional>
#include <system_error>

namespace shadowproof {

namespace {

constexpr std::size_t hash_size = 32; // hexadecimal digits of 128 bits

struct RecordHead {
    std::uint64_t length = 0;
    char hash[hash_size] = {};
};

std::string record_of(std::string_view bytes) {
    RecordHead head{.length = bytes.size()};
    std::memcpy(head.hash, fingerprint_of(bytes).xxh3.data(), hash_size);
    std::string record(sizeof head, '\0');
    std::memcpy(record.data(), &head, sizeof head);
    return record.append(bytes);
}

/// Takes the first record of `left`; none where it is cut off or damaged.
std::optional<std::string_view> take_record(std::string_view& left) {
    RecordHead head;
    if (left.size() < sizeof head) return std::nullopt;
    std::memcpy(&head, left.data(), sizeof head);
    if (left.size() - sizeof head < head.length) return std::nullopt;
    const std::string_view bytes = left.substr(sizeof head, head.length);
    if (fingerprint_of(bytes).xxh3 != std::string_view(head.hash, hash_size)) return std::nullopt;
    left.remove_prefix(sizeof head + head.length);
    return bytes;
}

Error unreadable(const std::filesystem::path& file, const std::error_code& why) {
    return {file.string(), fmt::format("cannot be read ({})", why.message()),
            "check its permissions, or leave out --resume"};
}

} // namespace

std::string WorkLog::work_in(const std::filesystem::path& file) {
    try {
        std::string bytes;
        read_pieces(file, [&](std::string_view piece) { bytes += piece; });
        std::string_view left(bytes);
        return std::string(take_record(left).value_or(std::string_view()));
    } catch (const std::system_error& error) {
        if (error.code().value() == ENOENT) return {};
        throw unreadable(file, error.code());
    }
}

WorkLog WorkLog::begun(const std::filesystem::path& file, const std::string& work) {
    try {
        WorkLog log(file, open_file(file, O_CREAT | O_EXCL | O_WRONLY | O_APPEND));
        log.write(work);
        return log;
    } catch (const std::system_error& error) {
        throw unwritable(file, error.code().value());
    }
}

WorkLog WorkLog::gone_on_with(const std::filesystem::path& file) {
    try {
        WorkLog log(file, open_file(file, O_WRONLY | O_APPEND | O_NOFOLLOW));
        std::string bytes;
        read_pieces(file, [&](std::string_view piece) { bytes += piece; });
        std::string_view left(bytes);
        take_record(left);
        while (const auto record = take_record(left))
            log.earlier_.push_back(unpacked<Message>(std::string(*record)));
        const auto whole = static_cast<off_t>(bytes.size() - left.size());
        if (::ftruncate(log.opened_.number(), whole) != 0) throw_errno();
        return log;
    } catch (const std::system_error& error) {
        throw unreadable(file, error.code());
    }
}

void WorkLog::write(std::string_view bytes) const {
    try {
        write_all(opened_, record_of(bytes));
    } catch (const std::system_error& error) {
        throw unwritable(file_, error.code().value());
    }
}

void WorkLog::add(const Message& message) const {
    switch (message.kind) {
    case Message::Kind::begun:
    case Message::Kind::ended:
    case Message::Kind::started:
        return write(packed(message));
    case Message::Kind::done:
        return write(
            packed(message.for_this_run ? Message{.kind = Message::Kind::ended} : message));
    case Message::Kind::aside:
    case Message::Kind::failed:
    case Message::Kind::result:
        return;
    }
}

} // namespace shadowproof
