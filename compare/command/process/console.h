// Console output while the program runs. Colour and a progress line only on a terminal; elsewhere
// plain lines, the same in each run except for times. Text from files is made printable, and cannot
// start a workflow command under GitHub Actions.
#pragma once

#include "compare/report/report.h"

#include <string>
#include <utility>
#include <vector>

namespace shadowproof {

class Console {
public:
    /// Checks whether stdout is a terminal, and the variables NO_COLOR (no-color.org) and TERM.
    /// `watcher`: the pipe to the process that says what takes long (guard.h); -1: there is none.
    explicit Console(bool quiet, int watcher = -1);
    ~Console();
    Console(const Console&) = delete;
    Console& operator=(const Console&) = delete;

    /// What is being done now; the next call of any kind replaces it.
    void progress(const std::string& text);
    /// Where in a run of several things it is, before all that follows: "scene 2 of 5: ".
    void begin_part(std::string place) { place_ = std::move(place); }
    /// Clears the progress line.
    void clear_progress();
    /// Clears the progress line of another process, which has ended.
    void take_over();
    /// While muted, nothing is printed: an earlier process has printed it already.
    void mute(bool muted) { muted_ = muted; }
    /// A line of results; not printed where quiet.
    void line(const std::string& text);
    /// Notes on a scene: if not `all`, the first three, and how many more there are.
    void notes(const std::vector<std::string>& notes, bool all);
    /// A heading, bold if colours are on.
    void heading(const std::string& text);
    /// A cell's line, with its verdict in colour if colours are on. If quiet, only a failed cell's.
    void cell(const SceneResult& scene, const Cell& cell, const ColumnWidths& widths, bool failed);
    /// What a cell's line does not say: its change since a baseline, what is excused, in bold, so
    /// that it is not read as agreement, and what is accepted or allowed. Not where quiet.
    void cell_details(const Cell& cell, const Gate& gate);
    /// A line that is printed even if quiet: failures and the summary.
    void always(const std::string& text);
    /// Whether GitHub's runner reads the lines (GITHUB_ACTIONS).
    bool on_github() const { return on_github_; }
    /// Prints workflow commands unchanged.
    void commands(const std::string& lines);

private:
    void print(const std::string& text);

    bool quiet_ = false;
    bool muted_ = false;
    int watcher_ = -1;
    bool on_github_ = false;
    bool terminal_ = false;
    bool color_ = false;
    bool progress_shown_ = false;
    std::string place_{};
};

} // namespace shadowproof
