// What a report shows of traced rays: those of every pixel that differs.
#pragma once

#include "compare/judge/evidence_report.h"
#include "compare/traced/ray_cause.h"

#include <memory>

namespace shadowproof {

/// `cause`: Comparison::cause.
std::shared_ptr<const EvidenceReport> report_rays(const TracedClaim& claim,
                                                  const Image<std::uint8_t>& cause);

} // namespace shadowproof
