#include "compare/stencil/stencil_report.h"

#include "compare/json/blocks.h"
#include "compare/stencil/ledger_table.h"
#include "compare/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

namespace shadowproof {

namespace {

using Json = nlohmann::ordered_json;

/// Stored in bytes if a counter fits into one.
NumberList counter_list(const Image<std::uint32_t>& counter, const Counting& counting) {
    if (counting.bits > 8) return NumberList(counter.pixels);
    return NumberList(converted<std::uint8_t>(counter, [](std::uint32_t count) {
                          return static_cast<std::uint8_t>(count);
                      }).pixels);
}

/// The crossings of one ledger after the other, and a 0 behind each: one more than its face, change
/// and tally as one number, as those of the same face mostly are the same.
NumberList crossing_list(const LedgerTable& ledgers) {
    std::vector<std::uint32_t> list;
    list.reserve(ledgers.crossing_face.size() + ledgers.start.size());
    for (std::size_t ledger = 0; ledger + 1 < ledgers.start.size(); ++ledger) {
        for (std::uint32_t i = ledgers.start[ledger]; i < ledgers.start[ledger + 1]; ++i)
            list.push_back((ledgers.crossing_face[i] << 4U |
                            (ledgers.crossing_change[i] < 0 ? 8U : 0U) |
                            ledgers.crossing_tally[i]) +
                           1U);
        list.push_back(0);
    }
    return NumberList(list);
}

std::string_view name_of(DepthModel::Projection projection) {
    switch (projection) {
    case DepthModel::Projection::finite:
        return "finite";
    case DepthModel::Projection::finite_reversed:
        return "finite_reversed";
    case DepthModel::Projection::infinite:
        return "infinite";
    case DepthModel::Projection::infinite_reversed:
        break;
    }
    return "infinite_reversed";
}

Json figure_of(const CheckedFigure& figure) {
    return {
        {"shown", figure.shown}, {"low", figure.predicted.low}, {"high", figure.predicted.high}};
}

Json volumes_of(const VolumeCheck& volumes) {
    Json json{{"checked", volumes.checked},
              {"unexplained", volumes.unexplained},
              {"fragments", figure_of(volumes.fragments)}};
    if (volumes.against) json["against"] = figure_of(*volumes.against);
    if (volumes.first)
        json["first"] = {{"x", volumes.first->x},
                         {"y", volumes.first->y},
                         {"faces", figure_of(volumes.first->faces)}};
    if (!volumes.holds()) json["words"] = words_of(volumes);
    return json;
}

Json header_of(const Frame& frame, const Scene& scene) {
    const Counting& counting = frame.counted->counting;
    const DepthModel& depth = frame.depth_model;
    Json header{{"counting",
                 {{"test", name_of(counting.test)},
                  {"operation", name_of(counting.operation)},
                  {"start", name_of(counting.start)},
                  {"depth_clamp", depth.clamp},
                  {"light_cap", counting.light_cap},
                  {"dark_cap", counting.dark_cap},
                  {"bits", counting.bits}}},
                {"depth",
                 {{"projection", name_of(depth.projection)},
                  {"floating", depth.floating},
                  {"near", depth.near},
                  {"far", std::isfinite(depth.far) ? Json(depth.far) : Json(nullptr)}}}};
    if (counting.casters.empty()) return header;
    Json& tests = header["counting"]["tests"] = Json::array(); // one per mesh
    for (const Mesh& mesh : scene.meshes)
        tests.push_back(name_of(counting.caster(mesh.first_triangle).test));
    return header;
}

class CounterReport final : public EvidenceReport {
public:
    CounterReport(const Json& header, LedgerTable ledgers, Image<std::uint32_t> predicted,
                  NumberList differing)
        : header_(header.dump()), ledgers_(std::move(ledgers)), predicted_(std::move(predicted)),
          differing_(std::move(differing)) {}

    std::string header() const override { return header_; }
    Blocks blocks(const Frame& frame, const GroundTruth& truth, Memo& memo) const override {
        const Counting& counting = frame.counted->counting;
        const int width = frame.claim.width;
        const NumberList claim(frame.claim.pixels);
        const NumberList predicted = counter_list(predicted_, counting);
        const Guide by_predicted{"predicted", &predicted};
        const NumberList seen(truth.triangle.pixels);
        const Guide by_seen{"seen", &seen};
        const auto of_differing = [&](const auto& list, const Guide& guide = {}) {
            return differing_block(NumberList(list), width, differing_, guide, &memo);
        };
        const auto rows = [](const auto& list, int columns = 1) {
            return sequence_block(NumberList(list), columns);
        };
        return {{"predicted", areas_block(predicted, width, {"claim", &claim}, &memo)},
                {"read_back", areas_block(counter_list(frame.counted->counter, counting), width,
                                          by_predicted, &memo)},
                {"faces", areas_block(NumberList(frame.counted->volumes.pixels), width,
                                      by_predicted, &memo)},
                {"shown", of_differing(ledgers_.shown, by_seen)},
                {"ledger", of_differing(ledgers_.ledger, by_seen)},
                {"ledger_counts", rows(ledgers_.counts, counts_of_ledger)},
                {"ledger_exact", rows(ledgers_.adds_up)},
                {"ledger_predicted", rows(ledgers_.predicted)},
                {"crossing", rows_block(crossing_list(ledgers_))},
                {"face", rows(ledgers_.face, 2)},
                {"triangle", rows(ledgers_.triangle, 4)},
                {"vertex", rows(ledgers_.vertex, 3)}};
    }

private:
    std::string header_;
    LedgerTable ledgers_;
    Image<std::uint32_t> predicted_; ///< the counter at each pixel's centre, as stored
    NumberList differing_;
};

} // namespace

EvidenceSummary summary_of(const Frame& frame, const EvidenceCheck& check,
                           const VolumeCheck& volumes) {
    const CounterEvidence& counted = *frame.counted;
    Json results{
        {"volume_fragments", counted.volume_fragments},
        {"ledger",
         {{"equal", check.equal}, {"in_band", check.in_band}, {"unexplained", check.unexplained}}},
        {"volumes", volumes_of(volumes)}};
    EvidenceSummary summary;
    if (counted.saved) {
        const Savings& saved = *counted.saved;
        results["saved"] = {{"against", saved.against},
                            {"ms", saved.milliseconds},
                            {"volume_fragments", saved.volume_fragments},
                            {"plan_ms", saved.plan_milliseconds}};
        summary.words = words_of(saved, counted.volume_fragments);
    }
    if (!volumes.holds()) summary.unexplained.push_back(words_of(volumes));
    summary.results = results.dump(-1, ' ', false, Json::error_handler_t::replace);
    return summary;
}

std::shared_ptr<const EvidenceReport> report_counters(const TracedScene& traced, const Frame& frame,
                                                      const Prediction& prediction,
                                                      const Image<std::uint8_t>& cause,
                                                      const MemoryBudget& left) {
    const Counting& counting = frame.counted->counting;
    return std::make_shared<CounterReport>(
        header_of(frame, traced.scene()),
        list_ledgers(traced.tracer(), traced.truth(), frame, prediction, cause, left),
        converted<std::uint32_t>(prediction.counts(),
                                 [&](std::int32_t count) { return stored(count, counting); }),
        differing_list(cause));
}

std::string words_of(const Savings& saved, std::uint64_t volume_fragments) {
    const std::int64_t fragments = saved.volume_fragments;
    const std::uint64_t all = volume_fragments + static_cast<std::uint64_t>(fragments);
    return fmt::format("saved {:.1f} ms and {}{} of {} volume fragments against {}",
                       saved.milliseconds, fragments < 0 ? "-" : "",
                       grouped(static_cast<std::uint64_t>(std::abs(fragments))), grouped(all),
                       saved.against);
}

} // namespace shadowproof
