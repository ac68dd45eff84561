// The time of a frame, and of its stages.
#pragma once

#include "raster/gl/gl.h"
#include "scenes/frame.h"

#include <chrono>
#include <string_view>
#include <vector>

namespace shadowproof {

/// Runs from its making. A stage ends once OpenGL has done all that it was asked for by then.
class StageClock {
public:
    explicit StageClock(const GlFunctions& gl)
        : gl_(&gl), start_(std::chrono::steady_clock::now()), last_(start_) {}

    void end(std::string_view stage);

    const std::vector<Stage>& stages() const { return stages_; }
    double milliseconds() const; ///< all stages together

private:
    const GlFunctions* gl_;
    std::chrono::steady_clock::time_point start_;
    std::chrono::steady_clock::time_point last_;
    std::vector<Stage> stages_;
};

/// The quickest of up to three frames, as many as are begun within 20 ms. `draw` takes the frame's
/// StageClock, and ends its last stage.
template <class Draw>
StageClock quickest_frame(const GlFunctions& gl, const Draw& draw) {
    StageClock quickest(gl);
    draw(quickest);
    double all = quickest.milliseconds();
    for (int i = 1; i < 3 && all < 20; ++i) {
        StageClock clock(gl);
        draw(clock);
        all += clock.milliseconds();
        if (clock.milliseconds() < quickest.milliseconds()) quickest = clock;
    }
    return quickest;
}

} // namespace shadowproof
