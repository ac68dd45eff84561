#include "compare/command/console.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
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
        break;
    }
    return "1;31";
}

std::string colored(std::string_view text, std::string_view parameters) {
    return fmt::format("\x1b[{}m{}\x1b[0m", parameters, text);
}

} // namespace

Console::Console(bool quiet) : quiet_(quiet), terminal_(isatty(STDOUT_FILENO) == 1) {
    const char* no_color = std::getenv("NO_COLOR");
    const char* term = std::getenv("TERM");
    const bool dumb = term == nullptr || std::string_view(term) == "dumb";
    terminal_ = terminal_ && !dumb;
    color_ = terminal_ && (no_color == nullptr || *no_color == '\0');
}

Console::~Console() {
    clear_progress();
}

void Console::clear_progress() {
    if (!progress_shown_) return;
    fmt::print("\r\x1b[K");
    std::fflush(stdout);
    progress_shown_ = false;
}

void Console::progress(const std::string& text) {
    if (quiet_ || !terminal_) return;
    clear_progress();
    fmt::print("{}", text);
    std::fflush(stdout);
    progress_shown_ = true;
}

void Console::line(const std::string& text) {
    if (!quiet_) always(text);
}

void Console::heading(const std::string& text) {
    line(color_ ? colored(text, "1") : text);
}

void Console::cell(const SceneResult& scene, const Cell& cell, const ColumnWidths& widths,
                   bool failed) {
    std::string text = cell_line(scene, cell, widths);
    if (color_) {
        const std::string verdict(cell.error.empty() ? name_of(cell.verdict) : "error");
        const std::size_t at =
            text.find("  " + verdict, cell.technique.size() + 2 + scene.name.size());
        if (at != std::string::npos)
            text.replace(at + 2, verdict.size(), colored(verdict, color_of(cell)));
    }
    if (failed)
        always(text);
    else
        line(text);
}

void Console::always(const std::string& text) {
    clear_progress();
    fmt::print("{}\n", text);
    // Each line at once also into a pipe: who waits for a build reads along.
    std::fflush(stdout);
}

} // namespace shadowproof
