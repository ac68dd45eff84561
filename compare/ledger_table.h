// The ledgers of every differing pixel of a cell, as flat lists: pixels whose rays cross the same
// faces with the same outcome share one ledger.
#pragma once

#include "compare/classify.h"
#include "reference/region_ledger.h"

#include <cstdint>
#include <vector>

namespace shadowproof {

struct LedgerTable {
    // A value a differing pixel, in rows from the top.
    std::vector<std::uint32_t> seen;  ///< triangle truly seen, or no_triangle
    std::vector<std::uint32_t> shown; ///< triangle that the technique shows, or no_triangle
    std::vector<std::uint8_t> exactness;
    std::vector<std::uint32_t> ledger; ///< which of the ledgers

    // A value a ledger, or as many as said.
    std::vector<std::uint32_t> start{0}; ///< of its crossings; one more at the end
    std::vector<std::int32_t> counts;    ///< 5: at eye, near, surface, far, infinity
    std::vector<std::uint8_t> adds_up;   ///< 1 where its crossings add up to its counts
    std::vector<std::int32_t> predicted; ///< the counter, before it wraps

    // A value a crossing.
    std::vector<std::uint32_t> crossing_face; ///< which of the faces
    std::vector<std::int8_t> crossing_change; ///< +1 or -1
    std::vector<std::uint8_t> crossing_tally; ///< Tally

    // What the others refer to.
    std::vector<std::uint32_t> face;     ///< 2 a face: triangle, Crossing::Part
    std::vector<std::uint32_t> triangle; ///< 4 a triangle: its index, three vertices; what is moved
                                         ///< to a volume's far end is numbered after all others
    std::vector<float> vertex;           ///< 3 a vertex, world space
};

/// `cause`: no_difference where a pixel agrees. All pictures have one size.
LedgerTable list_ledgers(const Tracer& tracer, const GroundTruth& truth, const Frame& frame,
                         const Prediction& prediction, const Image<std::uint8_t>& cause);

} // namespace shadowproof
