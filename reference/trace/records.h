// The float data of triangles for tests with rays from a common origin, with bounds of the errors
// of those tests.
#pragma once

#include "reference/trace/view.h"

#include <array>
#include <cstdint>
#include <vector>

namespace shadowproof {

/// Which triangles take part in a query, by their side in the view (OriginView::side).
enum class Part : std::uint8_t {
    seen,         ///< by the eye: not from behind, unless double sided
    occluding,    ///< all that are not edge-on
    light_facing, ///< those whose front faces the light
};

/// The triangles of a cluster that take part. For a ray O + s w, in scaled coordinates relative to
/// O, with the triangle oriented so that det(a, b, c) > 0: the ray meets the closed triangle iff w
/// . edge[k] >= 0 for all k, and then 1/s = w . inverse.
///   edge[0] = a x b, edge[1] = b x c, edge[2] = c x a,  inverse = (b - a) x (c - a) / det.
/// Where rays are parallel, a = (u, v, 1) and w likewise: the same holds of the ray that runs up at
/// (u, v), and w . inverse is the height h at which it meets the triangle's plane.
/// Each edge is divided by the error of its product: in float, |w . edge - exact| <= |w|, the
/// largest component, and |w . inverse - exact| <= |w| inverse_tolerance. Derived in records.cpp.
struct ClusterRecord {
    alignas(64) std::array<std::array<PerTriangle<float>, 3>, 3> edge{}; ///< by k, then axis
    std::array<PerTriangle<float>, 3> inverse{};                         ///< by axis
    /// Infinite where doubles cannot tell det from 0, or coordinates are beyond 1; edges are then
    /// 0.
    PerTriangle<float> inverse_tolerance{};
    PerTriangle<std::uint32_t> triangle{}; ///< of those in one place the first that takes part
    PerTriangle<std::uint32_t> copies{};   ///< how many take part in that place
    PerTriangle<std::uint32_t> plane{};    ///< Places::plane
    std::uint32_t members = 0;             ///< one bit for each that takes part
    std::uint32_t masked =
        0; ///< one for each that has a mask: whether it is met floats cannot tell
};

/// Creates records when they are first needed and keeps them in a small table, one per thread and
/// part, as neighbouring rays meet the same clusters.
class RecordCache {
public:
    /// `masks`: Tracer::State::masks, or null where triangles are met whatever their masks leave
    /// out.
    RecordCache(const OriginView& view, Part part, const std::vector<std::uint8_t>& double_sided,
                const std::vector<std::uint32_t>* masks);

    const OriginView& view() const { return *view_; }
    /// How many triangles take part in a triangle's place.
    std::uint32_t copies(std::uint32_t triangle) const;
    bool takes_part(std::uint32_t triangle) const;
    const ClusterRecord& of(std::uint32_t cluster) {
        if (slots_.empty()) slots_.resize(slot_count);
        Slot& slot = slots_[cluster % slot_count];
        if (slot.cluster != cluster) fill(slot, cluster);
        return slot.record;
    }
    /// A cluster in which rays of late met something; the first one where none did.
    std::uint32_t last_met() const { return last_met_; }
    void set_last_met(std::uint32_t cluster) { last_met_ = cluster; }

private:
    struct Slot {
        std::uint32_t cluster = 0xffffffffU;
        ClusterRecord record;
    };
    /// Enough for a strip of tiles, and small enough for the second-level cache.
    static constexpr std::size_t slot_count = 256;

    const OriginView* view_;
    Part part_;
    const std::vector<std::uint8_t>* double_sided_;
    const std::vector<std::uint32_t>* masks_;
    std::vector<Slot> slots_;
    std::uint32_t last_met_ = 0;

    void fill(Slot& slot, std::uint32_t cluster) const;
    std::uint32_t members_of(const ClusterSides& sides) const;
    std::uint32_t masked_of(const ClusterRecord& record) const;
    void choose_among_copies(std::uint32_t place, Cluster& chosen, std::uint32_t& front,
                             ClusterRecord& record) const;
};

} // namespace shadowproof
