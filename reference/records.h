// What a float needs to know of a triangle to test rays from a common origin, with the bounds of
// what that float can get wrong.
#pragma once

#include "reference/view.h"

#include <array>
#include <cstdint>
#include <vector>

namespace shadowproof {

/// Which triangles take part in a query.
enum class Part : std::uint8_t {
    seen,         ///< by the eye: not from behind, unless double sided
    occluding,    ///< all that are not edge-on
    light_facing, ///< those whose front the light sees
};

/// For a ray O + s w, in scaled coordinates relative to O, with the triangle oriented so that
/// det(a, b, c) > 0: the ray meets the closed triangle iff w . edge[k] >= 0 for all k, and then
/// 1/s = w . inverse.
///   edge[0] = a x b, edge[1] = b x c, edge[2] = c x a,  inverse = (b - a) x (c - a) / det.
/// In float, |w . edge - exact| <= |w| edge_tolerance and |w . inverse - exact| <=
/// |w| inverse_tolerance, |w| the largest component. Derived in records.cpp.
struct alignas(64) TriangleRecord {
    std::array<std::array<float, 3>, 3> edge{};
    std::array<float, 3> inverse{};
    float edge_tolerance = 0;
    float inverse_tolerance = 0; ///< infinite where det is too small for doubles to tell
    std::uint32_t triangle = 0;
    std::uint32_t unused = 0;
};

struct ClusterRecord {
    std::array<TriangleRecord, cluster_capacity> triangles{};
    std::uint32_t count = 0; ///< those that take part
};

/// Records are made when first asked for and kept in a small table, one for each thread and part:
/// neighbouring rays meet the same clusters.
class RecordCache {
public:
    RecordCache(const OriginView& view, Part part, const std::vector<std::uint8_t>& double_sided);

    const OriginView& view() const { return *view_; }
    const ClusterRecord& of(std::uint32_t cluster) {
        Slot& slot = slots_[cluster % slots_.size()];
        if (slot.cluster != cluster) fill(slot, cluster);
        return slot.record;
    }

private:
    struct Slot {
        std::uint32_t cluster = 0xffffffffU;
        ClusterRecord record;
    };
    const OriginView* view_;
    Part part_;
    const std::vector<std::uint8_t>* double_sided_;
    std::vector<Slot> slots_;

    void fill(Slot& slot, std::uint32_t cluster) const;
    bool takes_part(std::uint32_t triangle) const;
};

} // namespace shadowproof
