// A shadow map's evidence for results and report.
#pragma once

#include "compare/judge/evidence_report.h"
#include "compare/maps/lookup.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace shadowproof {

/// What a pixel's centre asks of the map, and what the map shows there.
struct PixelLookup {
    Lookup lookup;
    double stored = 0; ///< in the terms of Lookup::value
    std::uint32_t shown = no_triangle;
    int lit = 0;                ///< comparisons that find light, of MapModel::asked
    double width = 0;           ///< of the texel's side, where its rays are as deep as the point
    glm::dvec2 footprint{0, 0}; ///< of the texel on the receiver (footprint.h)
};

struct MapFigures {
    std::uint64_t straddling = 0;  ///< pixels that another texel than the centre's explains
    std::uint64_t asked = 0;       ///< texels
    std::uint64_t unexplained = 0; ///< texels
};

/// Members of the cell in results.json. Lengths are multiplied by `unit` (Scene::unit).
EvidenceSummary summary_of_map(const MapEvidence& map, const MapFigures& figures, double unit);

/// `at`: one for each pixel, in rows from the top; none where the map is not asked.
std::shared_ptr<const EvidenceReport> report_map(const MapEvidence& map,
                                                 const std::vector<std::optional<PixelLookup>>& at,
                                                 const Image<std::uint8_t>& cause, double unit);

} // namespace shadowproof
