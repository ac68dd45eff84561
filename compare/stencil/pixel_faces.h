// The surface that one pixel shows, and the faces of shadow volumes that may be counted there, as a
// rasterizer may draw them: sample by sample. A sample is a ray of the pixel's neighbourhood; it
// decides which faces cover the pixel. Their depths there are those of their planes, which the
// lateral error changes too: by much, if a face is steep.
#pragma once

#include "compare/driver/neighbourhood.h"
#include "compare/stencil/face_depths.h"
#include "compare/stencil/slivers.h"
#include "reference/predict/prediction.h"
#include "reference/trace/trace.h"
#include "scenes/frame.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace shadowproof {

/// Where a pixel's counters come from.
struct PixelVolumes {
    RegionLedger& counted; ///< the volumes that the technique counts, around the pixel
    const Scene& casters;  ///< of those volumes
    const std::vector<glm::vec3>* far_ends = nullptr; ///< their far ends, null at infinity
    RegionLedger* ideal = nullptr;      ///< those of the casters, where they are not the same
    std::span<const FlatVolume> flat{}; ///< see Volumes::flat
    std::int32_t counted_at_eye = 0;    ///< shadow depths of the eye
    std::int32_t ideal_at_eye = 0;
    const Volumes* masked = nullptr;  ///< these, where the scene has masks
    const Slivers* slivers = nullptr; ///< of the counted ones; null: not asked for
};

/// What the pixel shows if it is covered as one ray is.
struct Sample {
    glm::dvec3 line{0, 0, 0};
    double depth = 0;       ///< view depth of the shown surface
    double near = 0;        ///< the plane before which surfaces are not seen
    bool in_cone = true;    ///< as Reading::in_cone
    bool moved = false;     ///< only depths that are rounded show it, or order its faces so
    bool by_planes = false; ///< only planes that are rounded show it
    std::int64_t ideal = 0; ///< its shadow depth in the casters' own volumes,
                            ///< without what masks let through
    std::vector<Crossing> crossings{}; ///< of the counted volumes along the ray
};

/// A face that may be counted at a sample.
struct CandidateFace {
    Crossing crossing;
    bool nominally = false; ///< it is counted if no depth is rounded
    bool certain = false;   ///< whatever depths are rounded to, and wherever it is displaced to
};

/// View depths of the planes that clip. Each face is clipped by roundings of its own: between the
/// nearest and the furthest depth of the far plane it may be cut or not.
struct ClipDepths {
    double near = 0;
    double nearest_far = 0; ///< these are infinite where no far plane clips
    double far = 0;
    double furthest_far = 0;
    bool moved = false; ///< they are not the planes' own
};

/// How many steps a count may be lower or higher.
struct StepRange {
    std::int64_t least = 0;
    std::int64_t most = 0;
};

class PixelFaces {
public:
    /// Keeps references to all. `shown`: the triangle read back, or no_triangle. `truth`: what
    /// trace_rays finds along the neighbourhood's rays.
    PixelFaces(const Tracer& tracer, const PixelVolumes& volumes, const Frame& frame, double far,
               std::uint32_t shown, const Neighbourhood& around, std::span<const RayTruth> truth);

    /// Whether the shown surface may be seen where the pixel is covered as the ray is. If so, fills
    /// `sample`. `near`: where the near plane cuts surfaces on it.
    bool take(const glm::dvec3& line, const RayTruth& truth, double near, Sample& sample) const;
    /// The same of a ray of the neighbourhood.
    bool take(std::size_t ray, std::span<const RayTruth> truth, Sample& sample) const;

    /// Where the clipping planes may lie: their own depths, both nearer, both further.
    std::array<ClipDepths, 3> clip_depths() const;
    /// The sample's faces that are drawn, neither clipped nor on the wrong side of the surface for
    /// certain.
    std::vector<CandidateFace> candidates(const Sample& sample, const ClipDepths& clip) const;
    /// What the light caps add that the near plane cuts with their surfaces on the sample alone, or
    /// leaves.
    std::int64_t cut_with_surfaces(const Sample& sample) const;
    /// What the dark caps at infinity add to the count.
    std::int64_t dark_caps(const Sample& sample) const;
    /// Shadow depth where the sample's ray meets the near plane.
    std::int32_t depth_at_near(const Sample& sample) const;
    /// All that the counter may hold before the first face.
    const std::vector<std::int32_t>& starts() const { return starts_; }

    /// How many flat volumes the shown surface may come out among the faces of, at the sample.
    std::int64_t flat_volumes_around(const Sample& sample) const;
    /// Whether what is in front of the shown surface may let it be seen through a gap.
    bool may_gape() const { return may_gape_; }
    /// By how much light caps that are slivers in the picture may change the count, where their
    /// surfaces are not seen.
    StepRange steps_of_slivers() const;
    /// How many other faces are slivers there, of any depth.
    Slivers::Number slivers_of_any_depth() const;

    const PixelVolumes& volumes() const { return volumes_; }
    const Counting& counting() const { return frame_.counted->counting; }
    const Neighbourhood& around() const { return around_; }
    std::uint32_t shown() const { return shown_; }

private:
    const Tracer& tracer_;
    const PixelVolumes& volumes_;
    const Scene& scene_;
    const Frame& frame_;
    double far_;
    std::uint32_t shown_;
    const Neighbourhood& around_;
    FaceDepths depths_;
    DepthRange shown_range_;   ///< over the neighbourhood; nominal for the background alone
    bool may_cover_ = false;   ///< what is shown may cover the pixel's centre
    bool may_gape_ = false;    ///< what is in front of it may let it be seen through a gap
    bool may_be_seen_ = false; ///< that, or all of it may be drawn elsewhere
    std::vector<std::int32_t> starts_;

    bool lies_within(const SeenRange& planes, const glm::dvec3& line) const;
    bool certainly_in_front(std::uint32_t triangle) const;
    bool are_displaced(const std::vector<std::uint32_t>& triangles) const;
    bool is_displaced_cap(const Crossing& crossing, const DepthRange& range) const;
    std::vector<std::uint32_t> all_in_front() const;
    std::optional<double> shown_depth(const RayTruth& truth, const glm::dvec3& line,
                                      bool& moved) const;
    bool may_lie_in(const FlatVolume& flat, const Sample& sample) const;
    bool is_never_in_front(const Crossing& crossing) const;
    bool is_drawn_as_surface(const Crossing& crossing) const;
    std::int64_t ideal_depth(const Sample& sample, std::vector<Crossing>& crossings) const;
    bool is_nominally_in_front(const Crossing& crossing, const Sample& sample) const;
    std::int32_t depth_at_near(const std::vector<Crossing>& crossings, int move) const;
    std::vector<std::int32_t> possible_starts() const;
};

} // namespace shadowproof
