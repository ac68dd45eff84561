#include "compare/command/verify/supervisor.h"

#include "compare/command/child_process.h"
#include "compare/command/outcome.h"
#include "compare/command/standard_output.h"
#include "compare/command/verify/messages.h"
#include "scenes/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <span>
#include <stdexcept>
#include <utility>

namespace shadowproof {

namespace {

using Clock = std::chrono::steady_clock;

/// Without a terminal, what takes this long is reported in a line, and again after twice as long.
constexpr std::chrono::seconds silence{60};

/// The least time limit for OpenGL to start, which is not a cell.
constexpr double starting_seconds = 60;

class Supervisor {
public:
    Supervisor(const VerifyOptions& options, Console& console, Report& report)
        : options_(options), scenes_(scenes_to_verify(options)), console_(console),
          report_(report) {}

    bool all_tried() const { return done_; }

    StartingPoint starting_point() const {
        StartingPoint from{.scene = scene_, .light = light_, .begun = std::nullopt, .folders = {}};
        if (step_ == Step::cells) from.begun = report_.scenes.back();
        for (const SceneResult& scene : report_.scenes) from.folders.push_back(folder_of(scene));
        return from;
    }

    /// Follows one worker until it is done, crashes or takes too long.
    void follow(ChildProcess& worker) {
        MessageReader reader(worker.pipe());
        heard_something_ = false;
        goes_on_ = step_ == Step::cells;
        begin_step();
        while (!reader.at_end()) {
            if (const std::optional<Message> message = reader.next(milliseconds_to_wait())) {
                std::visit([&](const auto& said) { take(said); }, *message);
                begin_step();
            } else if (options_.timeout > 0 && Clock::now() >= deadline_) {
                worker.kill();
                worker.wait();
                return give_up(fmt::format("took longer than --timeout {}", options_.timeout),
                               true);
            }
            speak_up();
        }
        const ChildEnd end = worker.wait();
        if (!all_tried()) give_up("the process that tried it " + words_of(end), false);
    }

private:
    /// What the worker is doing.
    enum class Step : std::uint8_t {
        starting, ///< before OpenGL is there
        between,  ///< scenes
        reading,
        tracing,
        cells, ///< of the scene at the end of the report: between them
        trying ///< the cell at its end
    };

    const VerifyOptions& options_;
    std::vector<std::string> scenes_;
    Console& console_;
    Report& report_;
    Step step_ = Step::starting;
    std::size_t scene_ = 0;        ///< into scenes_
    std::size_t light_ = 0;        ///< of that scene
    std::size_t lights_ = 1;       ///< under which it is tried
    std::size_t first_result_ = 0; ///< of that scene, in the report
    bool done_ = false;
    bool heard_something_ = false; ///< of the worker that is followed
    bool goes_on_ = false; ///< it starts, reads and traces a scene anew for its further cells
    Clock::time_point step_began_;
    Clock::time_point deadline_;
    std::chrono::seconds speaks_after_ = silence;

    SceneResult& result() { return report_.scenes.back(); }

    void begin_step() {
        step_began_ = Clock::now();
        speaks_after_ = silence;
        const bool starting = step_ == Step::starting || step_ == Step::between || goes_on_;
        double seconds = starting ? std::max(options_.timeout, starting_seconds) : options_.timeout;
        if (goes_on_) seconds += 2 * options_.timeout;
        const std::chrono::duration<double> time(seconds);
        deadline_ = step_began_ + std::chrono::duration_cast<Clock::duration>(time);
    }

    int milliseconds_to_wait() const {
        Clock::time_point until = step_began_ + speaks_after_;
        if (options_.timeout > 0) until = std::min(until, deadline_);
        const auto left =
            std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now()).count();
        return static_cast<int>(std::max<std::int64_t>(left, 0));
    }

    void speak_up() {
        const auto taken = Clock::now() - step_began_;
        if (taken < speaks_after_) return;
        const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(taken).count();
        console_.line(fmt::format("{}: at it for {} s", what_is_done(), seconds));
        speaks_after_ *= 2;
    }

    std::string what_is_done() const {
        switch (step_) {
        case Step::starting:
        case Step::between:
            return "starting";
        case Step::reading:
            return report_.scenes.back().name + ": reading";
        case Step::tracing:
            return report_.scenes.back().name + ": tracing";
        case Step::cells:
            return report_.scenes.back().name + (goes_on_ ? ": reading it again" : ": writing");
        case Step::trying:
            break;
        }
        return report_.scenes.back().name + ": " + report_.scenes.back().cells.back().technique;
    }

    void take(const messages::Begun& begun) {
        report_.gl = begun.gl;
        report_.embree = begun.embree;
        if (step_ == Step::starting) step_ = Step::between;
    }
    void take(const messages::SceneBegun& begun) {
        heard_something_ = true;
        if (light_ == 0) first_result_ = report_.scenes.size();
        report_.scenes.push_back(begun.scene);
        step_ = light_ == 0 ? Step::reading : Step::tracing;
    }
    void take(const messages::SceneRead& read) {
        lights_ = read.lights;
        if (step_ == Step::reading) step_ = Step::tracing;
        if (!read.none_suits) return;
        report_.scenes.resize(first_result_);
        end_scene();
    }
    void take(const messages::SceneTraced& traced) {
        // Where an earlier worker began the scene, its cells stay.
        std::vector<Cell> cells = std::move(result().cells);
        result() = traced.scene;
        result().cells = std::move(cells);
        step_ = Step::cells;
        goes_on_ = false;
    }
    void take(const messages::SceneFailed& failed) {
        result().name = failed.name;
        fail_scene(failed.error);
    }
    void take(const messages::CellBegun& begun) {
        Cell& cell = result().cells.emplace_back();
        cell.technique = begun.technique;
        cell.summary = begun.summary;
        step_ = Step::trying;
        goes_on_ = false;
    }
    void take(const messages::CellDone& done) {
        result().cells.back() = done.cell;
        report_.report_milliseconds += done.report_milliseconds;
        step_ = Step::cells;
    }
    void take(const messages::SceneDone& /*done*/) { end_light(); }
    void take(const messages::RunFailed& failed) { throw std::runtime_error(failed.error); }
    void take(const messages::Done& /*done*/) { done_ = true; }

    /// A light's result is complete.
    void end_light() {
        step_ = Step::between;
        if (++light_ < lights_) return;
        SceneResult& last = result();
        last.no_longer_provoked =
            stopped_provoking(report_, std::span(report_.scenes).subspan(first_result_));
        if (!last.no_longer_provoked.empty())
            console_.always(last.name + ": " + no_longer_provoked_words(last));
        end_scene();
    }
    void end_scene() {
        step_ = Step::between;
        ++scene_;
        light_ = 0;
        lights_ = 1;
        // A worker that crashes after the last scene has tried all.
        done_ = scene_ == scenes_.size();
    }

    void fail_scene(const std::string& error) {
        // Cells that were judged stay.
        result().error = error;
        end_light();
    }

    /// What the worker was doing is lost: it becomes an error, and the next worker goes on after
    /// it.
    void give_up(const std::string& why, bool timed_out) {
        console_.progress(""); // what the worker last showed is replaced
        switch (step_) {
        case Step::starting:
        case Step::between:
            if (heard_something_) return; // between two scenes: the next worker goes on
            throw Error("OpenGL", why, "see the driver's own messages, or try another --gl");
        case Step::reading:
        case Step::tracing:
        case Step::cells:
            complain(fmt::format("{}: {}", what_is_done(), why));
            return fail_scene(fmt::format("{}: {}; {}", what_is_done(), why, remedy(timed_out)));
        case Step::trying:
            break;
        }
        Cell& cell = result().cells.back();
        if (timed_out) cell.verdict = Verdict::timed_out;
        cell.error = fmt::format("{}: {}; {}", cell.technique, why, remedy(timed_out));
        console_.cell(result(), cell, widths_of(options_.technique, result().name), true);
        step_ = Step::cells;
    }

    static const char* remedy(bool timed_out) {
        return timed_out
                   ? "give it more seconds (0: any number), a smaller --size, or a simpler scene"
                   : "report this with the scene; the other cells were tried all the same";
    }
};

} // namespace

void try_scenes_guarded(const VerifyOptions& options, const std::optional<ResultsFile>& baseline,
                        Console& console, ReportFolder& folder, Report& report) {
    Supervisor supervisor(options, console, report);
    while (!supervisor.all_tried()) {
        const StartingPoint from = supervisor.starting_point();
        ChildProcess worker([&](int pipe) {
            try_scenes({options, baseline, console, folder, pipe}, from);
            return static_cast<int>(exit_passed);
        });
        supervisor.follow(worker);
    }
}

} // namespace shadowproof
