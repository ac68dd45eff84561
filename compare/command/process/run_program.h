// Runs another program, without a shell and with a time limit.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace shadowproof {

/// How it ended: by itself with a code, by a signal, or at the time limit.
struct ProgramEnd {
    std::optional<int> code{};
    int signal = 0;
    bool timed_out = false;
};

/// "ended with code 3", "was ended by signal 11 (Segmentation fault)"
std::string words_of(const ProgramEnd& end);

/// Runs `words[0]`, looked for along PATH, with the other words as they are. Its input is empty,
/// its output and errors go to `log`. Whatever it has started ends with it, and with this process.
/// `seconds`: 0: no limit. Throws Error where it cannot be started.
ProgramEnd run_program(const std::vector<std::string>& words, const std::filesystem::path& log,
                       double seconds);

/// The words of a command, which are separated by white space. Quotes and backslashes hold words
/// together as in a shell; nothing else has a meaning. Throws std::invalid_argument where a quote
/// does not end.
std::vector<std::string> split_words(const std::string& command);

} // namespace shadowproof
