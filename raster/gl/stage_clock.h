// The time of a frame, and of its stages.
#pragma once

#include "raster/gl/gl.h"
#include "scenes/frame.h"

#include <chrono>
#include <string_view>
#include <vector>

namespace shadowproof {

/// Starts when it is constructed.
class StageClock {
public:
    enum class Waits {
        once,          ///< for OpenGL at the frame's end: only the frame's time is known
        at_each_stage, ///< which makes the frame slower, more so on graphics cards
    };
    StageClock(const GlFunctions& gl, Waits waits);

    /// To be called after the stage's last OpenGL call. What has the same name is one stage, in the
    /// place of the first.
    void end(std::string_view stage);
    void end_frame();

    const std::vector<Stage>& stages() const { return stages_; } ///< empty where it waits once
    double milliseconds() const { return milliseconds_; }        ///< of the frame, once it ended

private:
    const GlFunctions* gl_;
    Waits waits_;
    std::chrono::steady_clock::time_point start_;
    std::chrono::steady_clock::time_point last_;
    std::vector<Stage> stages_;
    double milliseconds_ = 0;
};

struct FrameTime {
    double milliseconds = 0;
    std::vector<Stage> stages{}; ///< of a frame of its own; empty unless asked for
};

/// Draws one frame with a single pixel, so that the driver finishes deferred compilation. `draw`:
/// as quickest_frame takes it.
template <class Draw>
void compile_all(const GlFunctions& gl, const Draw& draw) {
    gl.Scissor(0, 0, 1, 1);
    gl.Enable(GL_SCISSOR_TEST);
    StageClock clock(gl, StageClock::Waits::once);
    draw(clock);
    gl.Disable(GL_SCISSOR_TEST);
    gl.Finish();
}

/// The quickest of up to `most` frames, as many as are begun within 20 ms. `draw` takes the frame's
/// StageClock and ends its stages. `divided`: one more is drawn for the stages.
template <class Draw>
FrameTime quickest_frame(const GlFunctions& gl, int most, bool divided, const Draw& draw) {
    const auto drawn = [&](StageClock::Waits waits) {
        StageClock clock(gl, waits);
        draw(clock);
        clock.end_frame();
        return clock;
    };
    FrameTime time{.milliseconds = drawn(StageClock::Waits::once).milliseconds()};
    double all = time.milliseconds;
    for (int i = 1; i < most && all < 20; ++i) {
        const double one = drawn(StageClock::Waits::once).milliseconds();
        all += one;
        if (one < time.milliseconds) time.milliseconds = one;
    }
    if (divided) time.stages = drawn(StageClock::Waits::at_each_stage).stages();
    return time;
}

} // namespace shadowproof
