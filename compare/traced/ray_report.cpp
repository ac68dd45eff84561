#include "compare/traced/ray_report.h"

#include "compare/json/blocks.h"

#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <tuple>
#include <vector>

namespace shadowproof {

namespace {

constexpr float none = std::numeric_limits<float>::quiet_NaN();

/// Names of the numbers of a pixel, each a list of those of the pixels that differ, in rows from
/// the top.
struct RayNames {
    /// Of the shadow ray, and where it leaves its receiver's plane; NaN: there is none.
    static constexpr std::array<const char*, 9> ray{"origin_x",    "origin_y",    "origin_z",
                                                    "direction_x", "direction_y", "direction_z",
                                                    "near",        "far",         "leaves"};
    /// Triangles: seen; met by the shadow ray, as it was said, and first by exact tracing; passed
    /// over.
    static constexpr std::array<const char*, 4> met{"seen", "stopped", "first", "passed"};
    /// Where: on the eye ray, and of the last two on the shadow ray.
    static constexpr std::array<const char*, 3> at{"depth", "first_at", "passed_at"};
};

struct RayLists {
    std::array<std::vector<float>, RayNames::ray.size()> ray;
    std::array<std::vector<std::uint32_t>, RayNames::met.size()> met;
    std::array<std::vector<float>, RayNames::at.size()> at;
};

/// Each value behind those of its list.
template <class Lists, class Value>
void append(Lists& lists, const std::array<Value, std::tuple_size_v<Lists>>& values) {
    for (std::size_t i = 0; i < values.size(); ++i) lists[i].push_back(values[i]);
}

void add(RayLists& lists, const TracedClaim& claim, PixelPlace p) {
    const TracedPixel& pixel = claim.pixel(p);
    const ExactRays exact = trace_exactly(claim, p);
    const FloatRay& ray = pixel.shadow;
    const float leaves = exact.leaves_at ? static_cast<float>(*exact.leaves_at) : none;
    std::array<float, RayNames::ray.size()> shot{ray.origin.x,    ray.origin.y,    ray.origin.z,
                                                 ray.direction.x, ray.direction.y, ray.direction.z,
                                                 ray.near,        ray.far,         leaves};
    if (!pixel.shot) shot.fill(none);
    append(lists.ray, shot);
    const ExactHit first = exact.hits.empty() ? ExactHit{} : exact.hits.front();
    const ExactHit passed = exact.passed_over.value_or(ExactHit{});
    append(lists.met, std::array{pixel.seen, pixel.occluder, first.triangle, passed.triangle});
    append(lists.at,
           std::array{pixel.depth, static_cast<float>(first.t), static_cast<float>(passed.t)});
}

class TracedReport final : public EvidenceReport {
public:
    TracedReport(std::string header, RayLists lists, NumberList differing)
        : header_(std::move(header)), lists_(std::move(lists)), differing_(std::move(differing)) {}

    std::string header() const override { return header_; }
    Blocks blocks(const Frame& frame, const GroundTruth& /*truth*/, Memo& memo) const override {
        Blocks blocks;
        const auto add = [&](const auto& names, const auto& lists) {
            for (std::size_t i = 0; i < names.size(); ++i)
                blocks.emplace_back(names[i],
                                    differing_block(NumberList(lists[i]), frame.claim.width,
                                                    differing_, {}, &memo));
        };
        add(RayNames::ray, lists_.ray);
        add(RayNames::met, lists_.met);
        add(RayNames::at, lists_.at);
        return blocks;
    }

private:
    std::string header_;
    RayLists lists_;
    NumberList differing_;
};

} // namespace

std::shared_ptr<const EvidenceReport> report_rays(const TracedClaim& claim,
                                                  const Image<std::uint8_t>& cause) {
    RayLists lists;
    for (int y = 0; y < cause.height; ++y)
        for (int x = 0; x < cause.width; ++x)
            if (cause.at(x, y) != no_difference) add(lists, claim, {x, y});
    const std::string header = nlohmann::ordered_json{{"ray_unit", claim.scene().unit}}.dump();
    return std::make_shared<TracedReport>(header, std::move(lists), differing_list(cause));
}

} // namespace shadowproof
