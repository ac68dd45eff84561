#include "compare/stencil/stencil_judge.h"

#include "compare/driver/error_bounds.h"
#include "compare/stencil/coarse_counts.h"
#include "compare/stencil/figures/volume_check.h"
#include "compare/stencil/pixel_cause.h"
#include "compare/stencil/stencil_account.h"
#include "compare/stencil/stencil_report.h"
#include "compare/stencil/stencil_results.h"
#include "compare/stencil/strain.h"

#include <algorithm>
#include <limits>
#include <mutex>
#include <optional>

namespace shadowproof {

namespace {

/// The pixel's lateral error bounds. `ledger` must hold the ray.
BandRadius band_radius(const CountedClaim& judged, PixelPlace p, const glm::dvec3& line,
                       RegionLedger& ledger, std::vector<Crossing>& crossings) {
    const Scene& scene = judged.traced.scene();
    const auto at = [&](double depth) {
        return lateral_error(scene, judged.frame.depth_model, point_on(scene.camera, line, depth));
    };
    const double surface = std::min(judged.truth().depth.at(p.x, p.y), judged.traced.far());
    double nearest = surface;
    const Counting& counting = judged.counting();
    if (counting.test == Counting::Test::depth_pass || !counting.casters.empty()) {
        ledger.crossings(line, crossings);
        for (const Crossing& crossing : crossings)
            if (crossing.depth >= scene.camera.near &&
                counting.caster(crossing.triangle).test == Counting::Test::depth_pass)
                nearest = std::min(nearest, crossing.depth);
    }
    return {at(surface), at(nearest)};
}

/// The rays of a region's pixels and of all places to which they may be moved.
std::array<glm::dvec3, 4> corners_around(const Camera& camera, const Region& region,
                                         std::span<const Neighbourhood> around) {
    const int left = region.places.front().x / region_side * region_side;
    const int top = region.places.front().y / region_side * region_side;
    double reach = 0;
    for (const Neighbourhood& each : around) reach = std::max(reach, each.reach);
    return corner_lines(camera, left - reach, top - reach, left + region_side + reach,
                        top + region_side + reach);
}

/// Finds what may be drawn at a pixel: what is true in a neighbourhood, the pixel's own or one
/// across a coarse outline. The ledgers must hold its rays.
Finding find_in_band(const CountedClaim& judged, const Slivers& slivers, PixelPlace p,
                     const Neighbourhood& around, RegionLedger& counted, RegionLedger& ideal,
                     std::span<const RayTruth> truth) {
    const Volumes& volumes = judged.prediction.volumes();
    const PixelVolumes here{counted,
                            volumes.casters(),
                            volumes.far_ends(),
                            volumes.are_ideal() ? nullptr : &ideal,
                            volumes.flat(),
                            judged.prediction.depths().at_eye,
                            judged.prediction.ideal_depths().at_eye,
                            has_masks(judged.traced.scene()) ? &volumes : nullptr,
                            &slivers};
    const PixelBand band =
        find_band(judged.tracer(), here, judged.frame, judged.traced.far(),
                  judged.frame.triangle.at(p.x, p.y), around, truth,
                  [&](const Reading& reading) { return explains(judged, p, reading); });
    Finding finding;
    finding.evidence_in_band =
        std::any_of(band.readings.begin(), band.readings.end(), [&](const Reading& reading) {
            return judged.stored(reading.count) == judged.read_back(p);
        });
    if (judged.differs(p)) finding.cause = cause_in_band(judged, p, band, around, truth);
    return finding;
}

class StencilJudge final : public Judge {
public:
    StencilJudge(const TracedScene& traced, const Frame& frame)
        : prediction_(traced.volumes(), frame.counted->counting, frame.depth_model),
          claim_{{traced, frame},
                 prediction_,
                 receiving_triangles(traced.scene()),
                 sufficient_depths(traced.scene(), frame.depth_model)},
          slivers_(traced.scene(), prediction_.volumes(), frame, traced.far()) {}

    std::string_view evidence() const override { return "counter"; }

    bool settles(PixelPlace p, std::optional<PixelCause>& cause) const override {
        return settled(claim_, p, cause);
    }

    std::vector<BandRadius> radii(std::span<const PixelPlace> places) const override {
        const Camera& camera = claim_.traced.scene().camera;
        const int left = places.front().x / region_side * region_side;
        const int top = places.front().y / region_side * region_side;
        RegionLedger ledger = prediction_.volumes().ledger(
            corner_lines(camera, left, top, left + region_side, top + region_side));
        std::vector<Crossing> crossings;
        std::vector<BandRadius> radii;
        for (const PixelPlace& p : places)
            radii.push_back(band_radius(claim_, p, line_of_sight(camera, p.x + 0.5, p.y + 0.5),
                                        ledger, crossings));
        return radii;
    }

    void look_around(const Region& region, std::span<const Neighbourhood> around,
                     std::span<const RayTruth> truths) const override {
        const std::array<glm::dvec3, 4> corners =
            corners_around(claim_.traced.scene().camera, region, around);
        const Volumes& volumes = prediction_.volumes();
        const RegionLedger counted = volumes.ledger(corners);
        const RegionLedger ideal = volumes.ideal_ledger(corners);
        for (std::size_t i = 0; i < region.places.size(); ++i) {
            RegionLedger counted_here(counted, around[i].corners);
            RegionLedger ideal_here(ideal, around[i].corners);
            const std::span<const RayTruth> truth = truths.first(around[i].rays.size());
            truths = truths.subspan(truth.size());
            region.findings[i] = find_in_band(claim_, slivers_, region.places[i], around[i],
                                              counted_here, ideal_here, truth);
            excuse_where_displaced(region.places[i], region.findings[i]);
        }
    }

    Finding look_around(PixelPlace p, const Neighbourhood& around,
                        std::span<const RayTruth> truth) const override {
        RegionLedger counted = prediction_.volumes().ledger(around.corners);
        RegionLedger ideal = prediction_.volumes().ideal_ledger(around.corners);
        Finding finding = find_in_band(claim_, slivers_, p, around, counted, ideal, truth);
        excuse_where_displaced(p, finding);
        return finding;
    }

    void look_at_all_faces(std::span<const PixelPlace> places,
                           std::span<Finding> findings) const override {
        const Camera& camera = claim_.traced.scene().camera;
        std::vector<double> reach;
        for (const PixelPlace& p : places)
            reach.push_back(
                neighbourhood(camera, {p.x + 0.5, p.y + 0.5}, radii(std::span(&p, 1)).front())
                    .reach);
        const std::vector<CoarseCount> counts = coarse_counts(claim_, places, reach);
        for (std::size_t i = 0; i < places.size(); ++i)
            findings[i] = finding_by_all_faces(claim_, places[i], counts[i], findings[i]);
    }

    CoarseOutlines coarse_outlines() const override {
        const Scene& scene = claim_.traced.scene();
        const double far = claim_.frame.depth_model.clips_at_far()
                               ? claim_.traced.far()
                               : std::numeric_limits<double>::infinity();
        return {scene, &claim_.traced.silhouette(), prediction_.volumes().far_ends(),
                drawing_of(scene, claim_.frame.depth_model, far)};
    }

    EvidenceSummary summary(const EvidenceCheck& check,
                            const Image<std::uint8_t>& /*cause*/) const override {
        return summary_of(claim_.frame, check,
                          check_volumes(claim_.tracer(), claim_.traced.silhouette(),
                                        prediction_.volumes(), claim_.frame, claim_.traced.far()));
    }

    std::shared_ptr<const EvidenceReport> report(const Image<std::uint8_t>& cause,
                                                 const MemoryBudget& left) const override {
        return report_counters(claim_.traced, claim_.frame, prediction_, cause, left);
    }

    std::optional<double> strain() const override { return shadowproof::strain(claim_); }

    Account account(const PixelRecord& record, double unit) const override {
        return account_of_counter(claim_.frame, prediction_, record, unit);
    }

private:
    Prediction prediction_;
    CountedClaim claim_;
    Slivers slivers_;
    mutable std::once_flag outlines_made_;
    mutable std::optional<CoarseOutlines> outlines_; ///< made when they are first asked for

    /// No depth suffices where the clipper may draw an outline more than a pixel aside.
    void excuse_where_displaced(PixelPlace p, Finding& finding) const {
        if (!finding.cause.too_near) return;
        std::call_once(outlines_made_, [&] { outlines_ = coarse_outlines(); });
        if (outlines_->may_reach({p.x + 0.5, p.y + 0.5}, 1)) finding.cause.too_near = false;
    }
};

std::unique_ptr<Judge> judge(const TracedScene& traced, const Frame& frame) {
    return std::make_unique<StencilJudge>(traced, frame);
}

} // namespace

Family stencil_family() {
    return {.name = "stencil",
            .summary = "shadow volumes, counted in a buffer that is read back",
            .judge = judge,
            .check_results = check_stencil_results};
}

} // namespace shadowproof
