// The shadow volumes that a technique counts: the casters' own, out to infinity; of casters whose
// holes are filled; of some casters alone; or cut off where they are extruded by a finite distance.
#pragma once

#include "reference/region_ledger.h"
#include "scenes/frame.h"

#include <array>
#include <memory>
#include <vector>

namespace shadowproof {

class Volumes {
public:
    /// Keeps references to both.
    Volumes(const Tracer& tracer, const Silhouette& silhouette, const Counting& counting);
    ~Volumes();
    Volumes(Volumes&&) noexcept;
    Volumes& operator=(Volumes&&) noexcept = delete;
    Volumes(const Volumes&) = delete;
    Volumes& operator=(const Volumes&) = delete;

    /// How many casting triangles do, as triangles_touching_light has it.
    std::int64_t touching_light() const { return touching_light_; }
    /// The scene that casts; its first triangles are those of the scene that is seen.
    const Scene& casters() const;
    int threads() const;

    /// Shadow depths in these volumes, where `depths` are those in the casters' own. A point beyond
    /// a far end is no longer inside: there the end, taken for a caster, shadows it.
    ShadowDepths shadow_depths(const GroundTruth& truth, const ShadowDepths& depths) const;

    /// For the rays between four corners, as RegionLedger takes them.
    RegionLedger ledger(const std::array<glm::dvec3, 4>& corners) const;
    /// Where the casters' positions lie once extruded; null where that is at infinity.
    const std::vector<glm::vec3>* far_ends() const;
    /// Whether they are those of the casters as given, out to infinity.
    bool are_the_casters() const { return !others_ && !ends_; }
    /// Whether the shadows asked for are theirs: all casters', open where they are, to infinity,
    /// turned round where that is asked for. Otherwise, the ledger and depths of those.
    bool are_ideal() const { return are_ideal_; }
    RegionLedger ideal_ledger(const std::array<glm::dvec3, 4>& corners) const;
    ShadowDepths ideal_depths(const GroundTruth& truth, const ShadowDepths& depths) const;

private:
    struct Variant; ///< another scene under the same light and camera
    const Tracer* tracer_;
    const Silhouette* silhouette_;
    const Tracer* ideal_tracer_;
    const Silhouette* ideal_silhouette_;
    std::unique_ptr<Variant> others_; ///< see counted_casters.h
    std::unique_ptr<Variant> ends_;
    std::unique_ptr<Variant> ideal_; ///< where neither given nor counted ones are
    bool are_ideal_;
    std::int64_t touching_light_ = 0;
};

} // namespace shadowproof
