#include "compare/judge/class_judge.h"

#include "compare/driver/error_bounds.h"

#include <algorithm>
#include <limits>

namespace shadowproof {

bool ClassJudge::settles(PixelPlace p, std::optional<PixelCause>& /*cause*/) const {
    return !claim_.differs(p);
}

std::vector<BandRadius> ClassJudge::radii(std::span<const PixelPlace> places) const {
    const Scene& scene = claim_.traced.scene();
    std::vector<BandRadius> radii;
    for (const PixelPlace& p : places) {
        const double depth =
            std::min(claim_.traced.truth().depth.at(p.x, p.y), claim_.traced.far());
        const glm::dvec3 point =
            point_on(scene.camera, line_of_sight(scene.camera, p.x + 0.5, p.y + 0.5), depth);
        const double error = lateral_error(scene, claim_.frame.depth_model, point);
        radii.push_back({error, error + footprint()});
    }
    return radii;
}

void ClassJudge::look_around(const Region& region, std::span<const Neighbourhood> around,
                             std::span<const RayTruth> truths) const {
    for (std::size_t i = 0; i < region.places.size(); ++i) {
        const std::span<const RayTruth> truth = truths.first(around[i].rays.size());
        truths = truths.subspan(truth.size());
        region.findings[i] = look_around(region.places[i], around[i], truth);
    }
}

Finding ClassJudge::look_around(PixelPlace p, const Neighbourhood& /*around*/,
                                std::span<const RayTruth> truth) const {
    const bool is_edge =
        std::any_of(truth.begin(), truth.end(), [&](const RayTruth& t) { return allows(p, t); });
    return {.evidence_in_band = true, .cause = {is_edge ? Cause::edge : Cause::unexplained, {}}};
}

bool ClassJudge::allows(PixelPlace p, const RayTruth& truth) const {
    return truth.visibility == claim_.frame.claim.at(p.x, p.y);
}

CoarseOutlines ClassJudge::coarse_outlines() const {
    const Scene& scene = claim_.traced.scene();
    return {scene, nullptr, nullptr,
            drawing_of(scene, claim_.frame.depth_model, std::numeric_limits<double>::infinity())};
}

std::shared_ptr<const EvidenceReport> ClassJudge::report(const Image<std::uint8_t>& /*cause*/,
                                                         const MemoryBudget& /*left*/) const {
    return nullptr;
}

} // namespace shadowproof
