// The ledgers of every differing pixel of a cell, as flat lists: pixels whose rays cross the same
// faces with the same outcome share one ledger.
#pragma once

#include "reference/predict/prediction.h"
#include "reference/predict/region_ledger.h"
#include "scenes/memory_budget.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace shadowproof {

/// At eye, near, surface, far and infinity, and what masks let through of those at the surface.
inline constexpr std::size_t counts_of_ledger = 6;

struct LedgerTable {
    // One value per differing pixel, in rows from the top.
    std::vector<std::uint32_t> shown;  ///< triangle that the technique shows, or no_triangle
    std::vector<std::uint32_t> ledger; ///< index of its ledger

    // One value per ledger, or as many as stated.
    std::vector<std::uint32_t> start{0}; ///< index of its first crossing; one more at the end
    std::vector<std::int32_t> counts;    ///< counts_of_ledger of them
    std::vector<std::uint8_t> adds_up;   ///< 1 where its crossings add up to its counts
    std::vector<std::int32_t> predicted; ///< the counter, before it wraps

    // One value per crossing.
    std::vector<std::uint32_t> crossing_face; ///< index of its face
    std::vector<std::int8_t> crossing_change; ///< +1 or -1
    std::vector<std::uint8_t> crossing_tally; ///< Tally

    // What the others refer to.
    std::vector<std::uint32_t> face;     ///< 2 per face: triangle, Crossing::Part
    std::vector<std::uint32_t> triangle; ///< 4 per triangle: its index, three vertices; triangles
                                         ///< at a volume's far end are numbered after all others
    std::vector<float> vertex;           ///< 3 per vertex, world space
};

/// `cause`: no_difference where a pixel agrees. All pictures have the same size.
/// Throws Error where the table, and its text in a report, take more memory than is left beside the
/// program.
LedgerTable list_ledgers(const Tracer& tracer, const GroundTruth& truth, const Frame& frame,
                         const Prediction& prediction, const Image<std::uint8_t>& cause,
                         const MemoryBudget& left);

} // namespace shadowproof
