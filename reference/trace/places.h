// Triangles with the same corners, or in the same plane: what is decided for one of them holds for
// all.
#pragma once

#include "reference/exact/predicates.h"
#include "scenes/scene.h"

#include <cstdint>
#include <vector>

namespace shadowproof {

/// All are per triangle.
struct Places {
    std::vector<std::uint32_t> first; ///< the first with the same three corners, in any order;
                                      ///< its own where it has a mask
    std::vector<std::uint32_t> next;  ///< the next such one, or no_triangle
    std::vector<std::uint32_t> plane; ///< triangles with the same number lie exactly in one plane

    /// The first of each place, in ascending order.
    std::vector<std::uint32_t> firsts() const;
};

/// Whether two triangles have the same corners, in any order.
bool have_same_corners(const Corners& t, const Corners& u);

/// Whether u lies in the plane of t, exactly; always where t has no area.
bool are_coplanar(const Corners& t, const Corners& u);

/// Triangles in one plane may have different numbers because of rounding, and those with almost no
/// area always do. O(n) time.
Places find_places(const Scene& scene, const Predicates& predicates, int threads);

} // namespace shadowproof
