// What the reference's speed is compared with: the same eye and shadow rays traced by Embree in
// float, in its fastest mode for them (packets of 16, robust). Its answers are not exact.
#pragma once

#include "reference/trace/trace.h"
#include "scenes/scene.h"

#include <memory>

namespace shadowproof {

class FloatTracer {
public:
    explicit FloatTracer(const Scene& scene, int threads);
    ~FloatTracer();
    FloatTracer(const FloatTracer&) = delete;
    FloatTracer& operator=(const FloatTracer&) = delete;

    /// Eye rays of the whole picture, and a shadow ray where the reference traces one: from each
    /// seen point whose side faces the light.
    Image<Visibility> trace() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace shadowproof
