#include "reference/predict/volume_store.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace shadowproof {

namespace {

/// All by which volumes differ.
struct Key {
    Counting::Flips flips;
    bool holes_filled = false;
    double extrusion = 0;
    std::vector<std::uint8_t> left_out{}; ///< one flag per mesh; empty: none is
    friend bool operator==(const Key&, const Key&) = default;
};

Key key_of(const Scene& scene, const Counting& counting) {
    Key key{counting.flips, counting.holes_filled, counting.extrusion};
    if (counting.casters.empty()) return key;
    for (const Mesh& mesh : scene.meshes)
        key.left_out.push_back(mesh.triangle_count > 0 &&
                               counting.caster(mesh.first_triangle).left_out);
    if (std::ranges::count(key.left_out, 1) == 0) key.left_out.clear();
    return key;
}

} // namespace

/// Volumes that need another scene hold it, with all that is traced in it, and pictures of depths:
/// of these there is one at a time, beside those that are still in use.
struct VolumeStore::Kept {
    using Entry = std::pair<Key, std::shared_ptr<const CountedVolumes>>;
    std::mutex mutex;
    std::vector<Entry> of_the_casters;
    std::optional<Entry> of_others;
};

VolumeStore::VolumeStore(const Tracer& tracer, const Silhouette& silhouette,
                         const GroundTruth& truth, const ShadowDepths& depths)
    : tracer_(&tracer), silhouette_(&silhouette), truth_(&truth), depths_(&depths),
      kept_(std::make_unique<Kept>()) {}
VolumeStore::~VolumeStore() = default;

std::shared_ptr<const CountedVolumes> VolumeStore::counted(const Counting& counting) const {
    Key key = key_of(tracer_->scene(), counting);
    const std::lock_guard lock(kept_->mutex);
    for (const Kept::Entry& each : kept_->of_the_casters)
        if (each.first == key) return each.second;
    if (kept_->of_others && kept_->of_others->first == key) return kept_->of_others->second;
    const bool may_need_others = key != key_of(tracer_->scene(), {});
    if (may_need_others) kept_->of_others.reset(); // before further memory is taken
    Volumes volumes(*tracer_, *silhouette_, counting);
    const std::shared_ptr<const ShadowDepths> given(std::shared_ptr<void>(), depths_);
    std::shared_ptr<const ShadowDepths> depths = given;
    if (!volumes.are_the_casters())
        depths = std::make_shared<const ShadowDepths>(volumes.shadow_depths(*truth_, *depths_));
    std::shared_ptr<const ShadowDepths> ideal = depths;
    if (!volumes.are_ideal())
        ideal = volumes.ideal_are_the_casters()
                    ? given
                    : std::make_shared<const ShadowDepths>(volumes.ideal_depths(*truth_, *depths_));
    const bool are_others = depths != given || ideal != given;
    auto let_through = std::make_shared<const Image<std::int32_t>>(
        has_masks(tracer_->scene()) ? volumes.let_through(*truth_) : Image<std::int32_t>());
    Kept::Entry made{std::move(key), std::make_shared<const CountedVolumes>(
                                         CountedVolumes{std::move(volumes), std::move(depths),
                                                        std::move(ideal), std::move(let_through)})};
    if (are_others) return kept_->of_others.emplace(std::move(made)).second;
    return kept_->of_the_casters.emplace_back(std::move(made)).second;
}

} // namespace shadowproof
