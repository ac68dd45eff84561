// What a report shows of counted claims: figures, the volumes' faces at each pixel, ledgers.
#pragma once

#include "compare/judge/evidence_report.h"
#include "compare/stencil/figures/volume_check.h"
#include "reference/predict/prediction.h"
#include "reference/predict/traced_scene.h"
#include "scenes/memory_budget.h"

#include <memory>

namespace shadowproof {

EvidenceSummary summary_of(const Frame& frame, const EvidenceCheck& check,
                           const VolumeCheck& volumes);

/// `prediction`: of how the frame counts. `cause`: Comparison::cause. Throws Error where this takes
/// more memory than is left beside the program.
std::shared_ptr<const EvidenceReport> report_counters(const TracedScene& traced, const Frame& frame,
                                                      const Prediction& prediction,
                                                      const Image<std::uint8_t>& cause,
                                                      const MemoryBudget& left);

/// "saved 3.1 ms and 271,004 of 800,123 volume fragments against zfail_reversed"
std::string words_of(const Savings& saved, std::uint64_t volume_fragments);

} // namespace shadowproof
