// What workers have done, on disk, so that another run of the program goes on with it.
#pragma once

#include "compare/command/pieces/messages.h"
#include "compare/output/descriptor.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace shadowproof {

/// A file of records, each with its length and hash, so that one that was cut off ends it. The
/// first says what the work is. All functions throw Error naming the file.
class WorkLog {
public:
    /// What the work of a log is; empty where there is none, or where it does not say so.
    static std::string work_in(const std::filesystem::path& file);
    /// Begins a new one where there is none.
    static WorkLog begun(const std::filesystem::path& file, const std::string& work);
    /// Goes on with one, behind its last whole record.
    static WorkLog gone_on_with(const std::filesystem::path& file);

    /// The messages of earlier runs, as supervisors took them; to be taken once.
    std::vector<Message> take_earlier() { return std::exchange(earlier_, {}); }

    /// Keeps what a supervisor needs to know: pieces that are begun, ended or done, and when a new
    /// worker starts. Each is written in one call.
    void add(const Message& message) const;

private:
    std::filesystem::path file_;
    Descriptor opened_;
    std::vector<Message> earlier_{};

    WorkLog(std::filesystem::path file, Descriptor opened)
        : file_(std::move(file)), opened_(std::move(opened)) {}
    void write(std::string_view bytes) const;
};

} // namespace shadowproof
