// The shadow volumes that a technique counts: of the casters, to infinity; of casters with filled
// holes; of some casters alone; or cut off where they are extruded by a finite distance.
#pragma once

#include "reference/predict/flat_volume.h"
#include "reference/predict/region_ledger.h"
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

    /// The technique's volumes that are empty: they are not among the casters, and their faces can
    /// count only in their planes.
    const std::vector<FlatVolume>& flat() const { return flat_; }
    /// The casters including those of empty volumes, which are drawn all the same.
    const Scene& drawn_casters() const { return drawn_ ? *drawn_ : casters(); }
    /// One flag per triangle of the scene, or empty: flipped among the casters.
    const std::vector<std::uint8_t>& flipped() const { return flipped_; }
    /// The scene that casts; its first triangles are those of the visible scene.
    const Scene& casters() const;
    int threads() const;

    /// Shadow depths in these volumes; `depths` are those in the casters' own. A point beyond a far
    /// end is no longer inside: there the far end, treated as a caster, shadows the point.
    ShadowDepths shadow_depths(const GroundTruth& truth, const ShadowDepths& depths) const;

    /// What masks let through of the casters' own volumes: count_let_through.
    Image<std::int32_t> let_through(const GroundTruth& truth) const {
        return count_let_through(*tracer_, truth);
    }
    std::int32_t let_through(const glm::dvec3& line, std::uint32_t seen) const {
        return count_let_through(*tracer_, line, seen);
    }
    /// The same of the volumes that give the right shadows.
    std::int32_t ideal_let_through(const glm::dvec3& line, std::uint32_t seen) const {
        return count_let_through(*ideal_tracer_, line, seen);
    }

    /// For the rays between four corners, as RegionLedger takes them. Refers to these volumes.
    RegionLedger ledger(const std::array<glm::dvec3, 4>& corners) const;
    /// Where the casters' positions lie once extruded; null where that is at infinity.
    const std::vector<glm::vec3>* far_ends() const;
    /// Whether they are the volumes of the casters as given, to infinity.
    bool are_the_casters() const { return !others_ && !ends_; }
    /// Whether these volumes give the right shadows: those of all casters, with holes left open, to
    /// infinity, and flipped where the technique flips. Where they do not, ideal_ledger and
    /// ideal_depths are of those that do.
    bool are_ideal() const { return are_ideal_; }
    /// Whether those are the casters' own, whose depths are known.
    bool ideal_are_the_casters() const { return are_ideal_ ? are_the_casters() : !ideal_; }
    RegionLedger ideal_ledger(const std::array<glm::dvec3, 4>& corners) const;
    ShadowDepths ideal_depths(const GroundTruth& truth, const ShadowDepths& depths) const;

private:
    struct Variant; ///< another scene under the same light and camera
    const Tracer* tracer_;
    const Silhouette* silhouette_;
    const Tracer* ideal_tracer_;
    const Silhouette* ideal_silhouette_;
    std::vector<std::uint8_t> flipped_; ///< see flipped_triangles
    std::unique_ptr<Variant> others_;   ///< casters with holes filled, flipped, or left out
    std::unique_ptr<Variant> ends_;
    DepthSpan depths_{};             ///< of casters and ends, and as much on either side
    std::unique_ptr<Variant> ideal_; ///< where neither the given nor the counted ones are
    bool are_ideal_;
    std::vector<FlatVolume> flat_;
    std::unique_ptr<Scene> drawn_; ///< where they differ from the casters
};

} // namespace shadowproof
