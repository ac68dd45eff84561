#include "raster/gl/stage_clock.h"

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
    stages_.push_back({stage, milliseconds_of(now - last_)});
    last_ = now;
}

void StageClock::end_frame() {
    gl_->Finish();
    milliseconds_ = milliseconds_of(std::chrono::steady_clock::now() - start_);
}

} // namespace shadowproof
