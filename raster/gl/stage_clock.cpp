#include "raster/gl/stage_clock.h"

#include <algorithm>

namespace shadowproof {

namespace {

double milliseconds_of(std::chrono::steady_clock::duration duration) {
    return std::chrono::duration<double, std::milli>(duration).count();
}

} // namespace

StageClock::StageClock(const GlFunctions& gl, Waits waits)
    : gl_(&gl), waits_(waits), start_(std::chrono::steady_clock::now()), last_(start_) {}

void StageClock::end(std::string_view stage) {
    if (waits_ == Waits::once) return;
    gl_->Finish();
    const auto now = std::chrono::steady_clock::now();
    const auto same = std::ranges::find(stages_, stage, &Stage::name);
    Stage& ended = same == stages_.end() ? stages_.emplace_back(Stage{stage}) : *same;
    ended.milliseconds += milliseconds_of(now - last_);
    last_ = now;
}

void StageClock::end_frame() {
    gl_->Finish();
    milliseconds_ = milliseconds_of(std::chrono::steady_clock::now() - start_);
}

} // namespace shadowproof
