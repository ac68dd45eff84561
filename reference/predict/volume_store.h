// The shadow volumes that techniques count, made once for all techniques that count the same.
#pragma once

#include "reference/predict/ledger.h"
#include "reference/predict/volumes.h"

#include <memory>

namespace shadowproof {

/// Volumes, and the shadow depths in them.
struct CountedVolumes {
    Volumes volumes;
    std::shared_ptr<const ShadowDepths> depths;
    /// In the volumes that give the right shadows (Volumes::are_ideal).
    std::shared_ptr<const ShadowDepths> ideal_depths;
    /// What masks let through at each pixel (count_let_through); empty where the scene has none.
    std::shared_ptr<const Image<std::int32_t>> let_through;
};

class VolumeStore {
public:
    /// Keeps references. `depths`: those in the casters' own volumes.
    VolumeStore(const Tracer& tracer, const Silhouette& silhouette, const GroundTruth& truth,
                const ShadowDepths& depths);
    ~VolumeStore();
    VolumeStore(const VolumeStore&) = delete;
    VolumeStore& operator=(const VolumeStore&) = delete;

    const Tracer& tracer() const { return *tracer_; }
    const GroundTruth& truth() const { return *truth_; }
    const ShadowDepths& depths() const { return *depths_; }

    /// Those that a technique counts. Those that need no scene but the casters' are kept for good;
    /// of the others, only the latest. May be called by any thread; refers to what the store refers
    /// to.
    std::shared_ptr<const CountedVolumes> counted(const Counting& counting) const;

private:
    struct Kept;

    const Tracer* tracer_;
    const Silhouette* silhouette_;
    const GroundTruth* truth_;
    const ShadowDepths* depths_;
    std::unique_ptr<Kept> kept_;
};

} // namespace shadowproof
