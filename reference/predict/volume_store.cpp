#include "reference/predict/volume_store.h"

#include <algorithm>
#include <list>
#include <mutex>
#include <utility>
#include <vector>

namespace shadowproof {

namespace {

/// Techniques of one scene differ in their flips, in whether holes are filled, and in what is left
/// out. Each but the casters' own takes 16 bytes per pixel, or 32.
constexpr std::size_t most_kept = 3;

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

struct VolumeStore::Kept {
    std::mutex mutex;
    std::list<std::pair<Key, std::shared_ptr<const CountedVolumes>>> latest; ///< the last one first
};

VolumeStore::VolumeStore(const Tracer& tracer, const Silhouette& silhouette,
                         const GroundTruth& truth, const ShadowDepths& depths)
    : tracer_(&tracer), silhouette_(&silhouette), truth_(&truth), depths_(&depths),
      kept_(std::make_unique<Kept>()) {}
VolumeStore::~VolumeStore() = default;

std::shared_ptr<const CountedVolumes> VolumeStore::counted(const Counting& counting) const {
    Key key = key_of(tracer_->scene(), counting);
    const std::lock_guard lock(kept_->mutex);
    auto& latest = kept_->latest;
    const auto found = std::ranges::find(latest, key, [](const auto& each) { return each.first; });
    if (found != latest.end()) {
        latest.splice(latest.begin(), latest, found);
        return found->second;
    }
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
    latest.emplace_front(std::move(key),
                         std::make_shared<const CountedVolumes>(CountedVolumes{
                             std::move(volumes), std::move(depths), std::move(ideal)}));
    if (latest.size() > most_kept) latest.pop_back();
    return latest.front().second;
}

} // namespace shadowproof
