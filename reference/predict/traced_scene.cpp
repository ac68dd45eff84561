#include "reference/predict/traced_scene.h"

#include "scenes/plan/plan.h"

#include <atomic>
#include <mutex>
#include <optional>

namespace shadowproof {

struct TracedScene::State {
    const Tracer& tracer;
    const GroundTruth& truth;
    double far = 0;
    std::once_flag has_lights{};
    std::once_flag has_means{};
    std::once_flag has_silhouette{};
    std::once_flag has_depths{};
    std::once_flag has_volumes{};
    TracedLights lights_before{};
    PixelMeans pixel_means{};
    std::atomic<bool> knows_means{false};
    std::optional<Silhouette> silhouette{};
    std::optional<ShadowDepths> depths{};
    std::optional<VolumeStore> volumes{};
};

TracedScene::TracedScene(const Tracer& tracer, const GroundTruth& truth)
    : state_(new State{tracer, truth, finite_far(tracer.scene())}) {}
TracedScene::~TracedScene() = default;
TracedScene::TracedScene(TracedScene&&) noexcept = default;
TracedScene& TracedScene::operator=(TracedScene&&) noexcept = default;

const Tracer& TracedScene::tracer() const {
    return state_->tracer;
}
const Scene& TracedScene::scene() const {
    return state_->tracer.scene();
}
const GroundTruth& TracedScene::truth() const {
    return state_->truth;
}
double TracedScene::far() const {
    return state_->far;
}

const TracedLights& TracedScene::lights_before() const {
    std::call_once(state_->has_lights,
                   [&] { state_->lights_before = trace_lights_before(state_->tracer); });
    return state_->lights_before;
}

const PixelMeans& TracedScene::pixel_means() const {
    std::call_once(state_->has_means, [&] {
        state_->pixel_means = shade_pixels(state_->tracer, state_->truth, lights_before());
        state_->knows_means = true;
    });
    return state_->pixel_means;
}
const PixelMeans* TracedScene::known_pixel_means() const {
    return state_->knows_means ? &state_->pixel_means : nullptr;
}

const Silhouette& TracedScene::silhouette() const {
    std::call_once(state_->has_silhouette, [&] { state_->silhouette.emplace(state_->tracer); });
    return *state_->silhouette;
}

const ShadowDepths& TracedScene::depths() const {
    std::call_once(state_->has_depths, [&] {
        state_->depths = count_shadow_depths(state_->tracer, state_->truth, state_->far);
    });
    return *state_->depths;
}

const VolumeStore& TracedScene::volumes() const {
    std::call_once(state_->has_volumes, [&] {
        state_->volumes.emplace(state_->tracer, silhouette(), state_->truth, depths());
    });
    return *state_->volumes;
}

} // namespace shadowproof
