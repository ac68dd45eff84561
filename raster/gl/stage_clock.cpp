#include "raster/gl/stage_clock.h"

namespace shadowproof {

namespace {

double milliseconds_of(std::chrono::steady_clock::duration duration) {
    return std::chrono::duration<double, std::milli>(duration).count();
}

} // namespace

void StageClock::end(std::string_view stage) {
    gl_->Finish();
    const auto now = std::chrono::steady_clock::now();
    stages_.push_back({stage, milliseconds_of(now - last_)});
    last_ = now;
}

double StageClock::milliseconds() const {
    return milliseconds_of(last_ - start_);
}

} // namespace shadowproof
