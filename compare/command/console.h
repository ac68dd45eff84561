// What a person reads while the program runs. Colour and a progress line only where a terminal
// shows them; elsewhere plain lines, the same at each run but for the times. Text from files comes
// out printable, and under GitHub Actions starts no workflow command.
#pragma once

#include "compare/report.h"

#include <string>

namespace shadowproof {

class Console {
public:
    /// Looks whether stdout is a terminal, and at NO_COLOR (no-color.org) and TERM.
    explicit Console(bool quiet);
    ~Console();
    Console(const Console&) = delete;
    Console& operator=(const Console&) = delete;

    /// What is being done now; the next call of any kind replaces it.
    void progress(const std::string& text);
    /// Takes it away.
    void clear_progress();
    /// A line of results; not printed where quiet.
    void line(const std::string& text);
    /// A heading, bold where colour is.
    void heading(const std::string& text);
    /// A cell's line, its verdict in colour where colour is; where quiet only if it failed.
    void cell(const SceneResult& scene, const Cell& cell, const ColumnWidths& widths, bool failed);
    /// A line that is printed even where quiet: what failed, and the end.
    void always(const std::string& text);
    /// GITHUB_ACTIONS says that GitHub's runner reads the lines.
    bool on_github() const { return on_github_; }
    /// Workflow commands, as they are.
    void commands(const std::string& lines);

private:
    void print(const std::string& text);

    bool quiet_ = false;
    bool on_github_ = false;
    bool terminal_ = false;
    bool color_ = false;
    bool progress_shown_ = false;
};

} // namespace shadowproof
