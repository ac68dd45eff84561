#include "compare/traced/ray_report.h"

#include "compare/json/blocks.h"

#include <limits>
#include <nlohmann/json.hpp>

namespace shadowproof {

namespace {

constexpr float none = std::numeric_limits<float>::quiet_NaN();

/// One row for each pixel that differs, in the order of rows.
struct RayRows {
    std::vector<float> ray;         ///< origin, direction, near, far of the shadow ray, and where
                                    ///< it leaves its receiver's plane; NaN: there is none
    std::vector<std::uint32_t> met; ///< triangles: seen; met by the shadow ray, as it was said, and
                                    ///< first by exact tracing; passed over
    std::vector<float> at;          ///< where: on the eye ray, and the last two on the shadow ray
};

void add(RayRows& rows, const TracedClaim& claim, PixelPlace p) {
    const TracedPixel& pixel = claim.pixel(p);
    const ExactRays exact = trace_exactly(claim, p);
    const FloatRay& ray = pixel.shadow;
    const float leaves = exact.leaves_at ? static_cast<float>(*exact.leaves_at) : none;
    for (const float value : {ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x,
                              ray.direction.y, ray.direction.z, ray.near, ray.far, leaves})
        rows.ray.push_back(pixel.shot ? value : none);
    const ExactHit first = exact.hits.empty() ? ExactHit{} : exact.hits.front();
    const ExactHit passed = exact.passed_over.value_or(ExactHit{});
    for (const std::uint32_t triangle :
         {pixel.seen, pixel.occluder, first.triangle, passed.triangle})
        rows.met.push_back(triangle);
    for (const float t : {pixel.depth, static_cast<float>(first.t), static_cast<float>(passed.t)})
        rows.at.push_back(t);
}

class TracedReport final : public EvidenceReport {
public:
    TracedReport(std::string header, RayRows rows)
        : header_(std::move(header)), rows_(std::move(rows)) {}

    std::string header() const override { return header_; }
    Blocks blocks(const Frame& /*frame*/, const GroundTruth& /*truth*/,
                  Memo& /*memo*/) const override {
        return {{"ray", sequence_block(NumberList(rows_.ray), 9)},
                {"met", sequence_block(NumberList(rows_.met), 4)},
                {"at", sequence_block(NumberList(rows_.at), 3)}};
    }

private:
    std::string header_;
    RayRows rows_;
};

} // namespace

std::shared_ptr<const EvidenceReport> report_rays(const TracedClaim& claim,
                                                  const Image<std::uint8_t>& cause) {
    RayRows rows;
    for (int y = 0; y < cause.height; ++y)
        for (int x = 0; x < cause.width; ++x)
            if (cause.at(x, y) != no_difference) add(rows, claim, {x, y});
    const std::string header = nlohmann::ordered_json{{"ray_unit", claim.scene().unit}}.dump();
    return std::make_shared<TracedReport>(header, std::move(rows));
}

} // namespace shadowproof
