// The evidence of a cell: words and figures, which are sent between processes, and data for the
// report, which are written by the process that makes them.
#pragma once

#include "compare/json/memo.h"
#include "reference/trace/trace.h"
#include "scenes/frame.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace shadowproof {

/// Compares what was read back with the prediction, at every pixel. A surface that no rasterizer
/// would show (surface_check.h) leaves the pixel unexplained, whatever its evidence.
struct EvidenceCheck {
    std::uint64_t equal = 0;       ///< at the pixel's centre
    std::uint64_t in_band = 0;     ///< equal to a value inside the pixel's band
    std::uint64_t unexplained = 0; ///< neither; always a failure
    int first_x = 0;               ///< the first unexplained, in rows from the top
    int first_y = 0;
};

/// Figures of the evidence as a whole.
struct EvidenceSummary {
    std::vector<std::string> unexplained; ///< one clause per figure or picture that is not as
                                          ///< predicted; any fails the cell
    std::string results; ///< members of the cell in results.json, as the text of a JSON object
    std::string words;   ///< for the cell's line on the console; empty: none
};

/// A named list of values for the viewer, encoded (compare/json/blocks.h).
using Blocks = std::vector<std::pair<std::string, std::string>>;

/// What a report shows of the evidence. The memo is that of the scene.
class EvidenceReport {
public:
    EvidenceReport() = default;
    virtual ~EvidenceReport() = default;
    EvidenceReport(const EvidenceReport&) = delete;
    EvidenceReport& operator=(const EvidenceReport&) = delete;

    /// Members of the header of the cell's data, as the text of a JSON object.
    virtual std::string header() const = 0;
    /// `truth`: the scene's, whose triangles are a block of the scene's data, "seen".
    virtual Blocks blocks(const Frame& frame, const GroundTruth& truth, Memo& memo) const = 0;
};

} // namespace shadowproof
