// A scene and its truth, against which claims are judged; computed once for all of them.
#pragma once

#include "reference/predict/ledger.h"
#include "reference/predict/region_ledger.h"
#include "reference/predict/volume_store.h"
#include "reference/shade/pixel_means.h"
#include "reference/trace/lights_before.h"
#include "reference/trace/trace.h"

#include <memory>

namespace shadowproof {

/// A scene under its chosen light, traced. What only some families of claims need is computed on
/// first use, by any thread. Keeps references.
class TracedScene {
public:
    TracedScene(const Tracer& tracer, const GroundTruth& truth);
    ~TracedScene();
    TracedScene(TracedScene&&) noexcept;
    TracedScene& operator=(TracedScene&&) noexcept;
    TracedScene(const TracedScene&) = delete;
    TracedScene& operator=(const TracedScene&) = delete;

    const Tracer& tracer() const;
    const Scene& scene() const;
    const GroundTruth& truth() const;
    /// View depth of the finite far plane of the techniques that have one (finite_far).
    double far() const;

    /// The same under the lights whose light its colours add to the chosen one's.
    const TracedLights& lights_before() const;
    /// The true colours as means over the pixels; the scene must be bump-lit.
    const PixelMeans& pixel_means() const;
    /// Null where nobody has asked for them yet.
    const PixelMeans* known_pixel_means() const;
    /// The sides of the casters' shadow volumes.
    const Silhouette& silhouette() const;
    /// Shadow depths at the points of each pixel's ray.
    const ShadowDepths& depths() const;
    /// The volumes that techniques count.
    const VolumeStore& volumes() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace shadowproof
