#include "compare/command/process/console.h"

#include "compare/command/process/standard_output.h"
#include "compare/report/escape.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <climits>
#include <cstdlib>
#include <string_view>

namespace shadowproof {

namespace {

/// ECMA-48 "select graphic rendition" parameters.
std::string_view color_of(const Cell& cell) {
    if (!cell.error.empty()) return "1;31";
    switch (cell.verdict) {
    case Verdict::agrees:
        return "32";
    case Verdict::fails_as_predicted:
        return "33";
    case Verdict::defect:
    case Verdict::unexplained:
    case Verdict::timed_out:
        break;
    }
    return "1;31";
}

std::string colored(std::string_view text, std::string_view parameters) {
    return fmt::format("\x1b[{}m{}\x1b[0m", parameters, text);
}

/// A line into the watcher's pipe, in one call, so that those of several processes do not mix.
/// Where the watcher is gone, this process is about to end.
void tell(int watcher, const std::string& text) {
    const std::string line = text.substr(0, PIPE_BUF - 1) + "\n";
    [[maybe_unused]] const ssize_t written = write(watcher, line.data(), line.size());
}

/// GitHub's runner takes a line for a command that begins with "::" after any spaces, or holds
/// "##[" anywhere; text from a file may do neither.
std::string without_commands(std::string text) {
    const std::size_t first = text.find_first_not_of(" \t");
    if (first != std::string::npos && text.compare(first, 2, "::") == 0)
        text.insert(first + 1, " ");
    for (std::size_t at = text.find("##["); at != std::string::npos; at = text.find("##[", at))
        text.insert(at + 1, " ");
    return text;
}

} // namespace

Console::Console(bool quiet, int watcher)
    : quiet_(quiet), watcher_(watcher), terminal_(isatty(STDOUT_FILENO) == 1) {
    const char* no_color = std::getenv("NO_COLOR");
    const char* term = std::getenv("TERM");
    const bool dumb = term == nullptr || std::string_view(term) == "dumb";
    terminal_ = terminal_ && !dumb;
    const char* github = std::getenv("GITHUB_ACTIONS");
    on_github_ = github != nullptr && std::string_view(github) == "true";
    color_ = terminal_ && (no_color == nullptr || *no_color == '\0');
}

Console::~Console() {
    try {
        clear_progress();
    } catch (const OutputLost&) { // was reported already
    }
}

void Console::clear_progress() {
    if (!progress_shown_) return;
    progress_shown_ = false;
    shadowproof::print("\r\x1b[K");
}

void Console::take_over() {
    if (terminal_ && !quiet_) progress_shown_ = true;
    clear_progress();
}

void Console::progress(const std::string& text) {
    if (quiet_ || muted_) return;
    const std::string shown = printable(place_ + text);
    if (watcher_ >= 0) tell(watcher_, shown);
    if (!terminal_) return;
    clear_progress();
    shadowproof::print(shown);
    progress_shown_ = true;
}

void Console::line(const std::string& text) {
    if (!quiet_) always(text);
}

void Console::notes(const std::vector<std::string>& notes, bool all) {
    constexpr std::size_t usual = 3;
    const std::size_t shown = all ? notes.size() : std::min(notes.size(), usual);
    for (std::size_t i = 0; i < shown; ++i) line("  note: " + notes[i]);
    if (shown < notes.size())
        line(fmt::format("  and {}: -v shows them", counted(notes.size() - shown, "more note")));
}

void Console::heading(const std::string& text) {
    if (quiet_) return;
    print(color_ ? colored(printable(text), "1") : printable(text));
}

void Console::cell(const SceneResult& scene, const Cell& cell, const ColumnWidths& widths,
                   bool failed) {
    if (quiet_ && !failed) return;
    std::string text = printable(cell_line(scene, cell, widths));
    if (color_) {
        const std::string verdict(outcome_name(cell));
        const std::size_t at =
            text.find("  " + verdict, cell.technique.size() + 2 + printable(scene.name).size());
        if (at != std::string::npos)
            text.replace(at + 2, verdict.size(), colored(verdict, color_of(cell)));
    }
    print(text);
}

void Console::cell_details(const Cell& cell, const Gate& gate) {
    if (!cell.error.empty()) return;
    if (cell.since) line("  since the baseline: " + words_of(*cell.since));
    if (const std::string excused = excused_words(cell, gate); !excused.empty())
        heading("  " + excused);
    for (const Acceptance& one : cell.accepted)
        line(fmt::format("  accepted: {}: {}", name_of(one.cause), one.reason));
    const std::string allowed = cause_counts(pixels_allowed(cell, gate));
    if (!allowed.empty()) line("  allowed: " + allowed);
}

void Console::always(const std::string& text) {
    print(printable(text));
}

void Console::commands(const std::string& lines) {
    if (muted_) return;
    clear_progress();
    shadowproof::print(lines);
}

void Console::print(const std::string& text) {
    if (muted_) return;
    clear_progress();
    // Each line is flushed also into a pipe, as a person may follow the build.
    shadowproof::print((on_github_ ? without_commands(text) : text) + "\n");
}

} // namespace shadowproof
