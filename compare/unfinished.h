// Files and folders that are being written beside their place, so that whoever interrupts the
// program finds none of them.
#pragma once

#include <filesystem>
#include <mutex>

namespace shadowproof {

/// A path beside `place` for something unfinished: "report.writing-4711". Whatever stands there
/// when this goes, or when a signal ends the program, is removed.
class Unfinished {
public:
    explicit Unfinished(const std::filesystem::path& place);
    ~Unfinished();
    Unfinished(const Unfinished&) = delete;
    Unfinished& operator=(const Unfinished&) = delete;

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// Held while anything unfinished is written, so that it cannot grow behind the one who removes it.
/// One thread may hold several.
std::unique_lock<std::recursive_mutex> hold_unfinished();

/// From here on SIGINT, SIGTERM and SIGHUP remove what is unfinished before they end the program.
/// To be called once, before any other thread is started: they inherit what is blocked.
void remove_unfinished_at_signals();

} // namespace shadowproof
