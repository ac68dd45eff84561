#include "compare/traced/traced_judge.h"

#include "compare/traced/ray_cause.h"
#include "compare/traced/ray_report.h"
#include "compare/traced/ray_story.h"
#include "compare/traced/ray_strain.h"
#include "compare/traced/traced_results.h"
#include "reference/parallel.h"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace shadowproof {

namespace {

/// Rays have no lateral error: their floats are known, and no rasterizer snaps them. So nothing is
/// looked for around a pixel, and nothing is `edge`: a pixel is settled at its centre, or
/// unexplained.
class TracedJudge final : public Judge {
public:
    TracedJudge(const TracedScene& traced, const Frame& frame)
        : judged_{traced, frame}, claim_{traced, frame}, of_all_(fault_of_all(claim_)),
          faults_(frame.claim.width, frame.claim.height),
          causes_(frame.claim.width, frame.claim.height) {
        if (!of_all_.empty()) return;
        parallel_for((frame.claim.height + ray_tile - 1) / ray_tile, traced.tracer().threads(),
                     [&](int row, int) {
                         for (int left = 0; left < frame.claim.width; left += ray_tile)
                             judge_tile(left, row * ray_tile);
                     });
    }

    std::string_view evidence() const override { return "ray"; }

    bool settles(PixelPlace p, std::optional<PixelCause>& cause) const override {
        if (!fault_at(p).empty()) return false;
        if (judged_.differs(p)) cause = causes_.at(p.x, p.y);
        return true;
    }

    std::vector<BandRadius> radii(std::span<const PixelPlace> places) const override {
        return std::vector<BandRadius>(places.size());
    }
    void look_around(const Region& region, std::span<const Neighbourhood> /*around*/,
                     std::span<const RayTruth> /*truths*/) const override {
        for (Finding& finding : region.findings) finding = {};
    }
    Finding look_around(PixelPlace /*p*/, const Neighbourhood& /*around*/,
                        std::span<const RayTruth> /*truth*/) const override {
        return {};
    }
    CoarseOutlines coarse_outlines() const override {
        const Scene& scene = judged_.traced.scene();
        return {
            scene, nullptr, nullptr,
            drawing_of(scene, judged_.frame.depth_model, std::numeric_limits<double>::infinity())};
    }

    EvidenceSummary summary(const EvidenceCheck& check,
                            const Image<std::uint8_t>& /*cause*/) const override {
        std::uint64_t shot = 0;
        for (const TracedPixel& pixel : claim_.rays().pixels.pixels) shot += pixel.shot ? 1 : 0;
        EvidenceSummary summary;
        summary.results = nlohmann::ordered_json{{"rays",
                                                  {{"shadow", shot},
                                                   {"as_traced_exactly", check.equal},
                                                   {"unexplained", check.unexplained}}}}
                              .dump();
        if (check.unexplained > 0)
            summary.words =
                fmt::format("the first pixel's {}", fault_at({check.first_x, check.first_y}));
        return summary;
    }
    std::shared_ptr<const EvidenceReport> report(const Image<std::uint8_t>& cause,
                                                 const MemoryBudget& /*left*/) const override {
        return of_all_.empty() ? report_rays(claim_, cause) : nullptr;
    }
    std::optional<double> strain() const override { return shadowproof::strain(claim_); }
    Account account(const PixelRecord& record, double unit) const override {
        const PixelPlace p{record.x, record.y};
        return account_of_rays(claim_, p, fault_at(p), unit);
    }

private:
    JudgedClaim judged_;
    TracedClaim claim_;
    RayFault of_all_; ///< of all pixels, if any
    Image<RayFault> faults_;
    Image<PixelCause> causes_; ///< where a pixel without fault differs

    RayFault fault_at(PixelPlace p) const {
        return of_all_.empty() ? faults_.at(p.x, p.y) : of_all_;
    }
    void judge_tile(int left, int top) {
        RayTile tile = tile_at(judged_.frame, left, top);
        check_rays(claim_, tile);
        for (std::size_t l = 0; l < tile.places.size(); ++l) {
            if ((tile.lanes >> l & 1U) == 0) continue;
            const PixelPlace p = tile.places[l];
            faults_.at(p.x, p.y) = tile.faults[l];
            if (tile.faults[l].empty() && judged_.differs(p))
                causes_.at(p.x, p.y) = cause_of_rays(claim_, p);
        }
    }
};

std::unique_ptr<Judge> judge(const TracedScene& traced, const Frame& frame) {
    return std::make_unique<TracedJudge>(traced, frame);
}

} // namespace

Family traced_family() {
    return {.name = "traced",
            .summary = "shadow rays traced in float",
            .judge = judge,
            .check_results = check_traced_results};
}

} // namespace shadowproof
