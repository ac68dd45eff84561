#include "compare/stencil/stencil_account.h"

#include "compare/driver/sufficient_depths.h"
#include "compare/judge/crossing_json.h"
#include "reference/predict/tally.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace shadowproof {

namespace {

using Json = nlohmann::ordered_json;

/// What happened to the counter of the record's pixel.
struct CounterAtPixel {
    std::int64_t start = 0;     ///< the counter before any face
    std::int64_t predicted = 0; ///< the counter before wrapping
    std::uint32_t stored = 0;   ///< as the stencil buffer should hold it
    std::uint32_t read_back = 0;
    std::vector<Crossing> crossings; ///< of the technique's volumes
    bool other_volumes = false;      ///< which are not the casters' own
    std::vector<Tally> tallies;      ///< one per crossing
    Tally dark_caps = Tally::beyond;
    std::int64_t dark_cap_count = 0; ///< at infinity
};

CounterAtPixel counter_at(const Frame& frame, const Prediction& prediction,
                          const PixelRecord& record) {
    const Counting& counting = frame.counted->counting;
    const int x = record.x;
    const int y = record.y;
    CounterAtPixel at;
    at.start = start_of(counting, prediction.depths().at_eye, prediction.depths().at_near.at(x, y));
    at.predicted = prediction.counts().at(x, y);
    at.stored = stored(at.predicted, counting);
    at.read_back = frame.counted->counter.at(x, y);
    const Volumes& volumes = prediction.volumes();
    at.other_volumes = !volumes.are_the_casters();
    if (at.other_volumes)
        volumes.ledger(corner_lines(volumes.casters().camera, x, y, x + 1, y + 1))
            .crossings(line_of_sight(volumes.casters().camera, x + 0.5, y + 0.5), at.crossings);
    else
        at.crossings = record.ledger.crossings;
    for (const Crossing& crossing : at.crossings)
        at.tallies.push_back(tally(crossing, record.ledger.surface, record.seen, record.far,
                                   counting, frame.depth_model));
    at.dark_caps = tally_of_dark_caps(counting, frame.depth_model);
    at.dark_cap_count = dark_caps_at_infinity(counting, prediction.depths().at_eye, at.crossings);
    return at;
}

std::string_view loss_words(Tally tally) {
    switch (tally) {
    case Tally::lost_near:
        return "before the near plane";
    case Tally::lost_far:
        return "past the far plane";
    case Tally::lost_cap:
        return "on a missing cap";
    case Tally::counted:
    case Tally::beyond:
        break;
    }
    return {};
}

/// "+1 at 3.2 before the near plane, 2 dark caps past the far plane"
std::string lost_words(const CounterAtPixel& at, const Counting& counting, std::int32_t around_eye,
                       double unit) {
    std::string lost;
    const auto add = [&](const std::string& what, Tally tally) {
        if (loss_words(tally).empty()) return;
        lost += fmt::format("{}{} {}", lost.empty() ? "" : ", ", what, loss_words(tally));
    };
    for (std::size_t i = 0; i < at.tallies.size(); ++i)
        add(fmt::format("{:+} at {:.9g}", at.crossings[i].change, at.crossings[i].depth * unit),
            at.tallies[i]);
    const std::int64_t open = at.dark_cap_count;
    if (open != 0) add(fmt::format("{} dark {}", open, open == 1 ? "cap" : "caps"), at.dark_caps);
    if (counting.test == Counting::Test::depth_pass && around_eye != 0)
        lost += fmt::format("{}{} around the eye", lost.empty() ? "" : ", ", around_eye);
    return lost;
}

/// "meets +1 at 3.2, -1 at 5"; empty where the volumes are met as the casters' own are.
std::string other_volumes_words(const CounterAtPixel& at, const PixelRecord& record, double unit) {
    const auto same = [](const Crossing& a, const Crossing& b) {
        return a.depth == b.depth && a.change == b.change;
    };
    if (!at.other_volumes || std::ranges::equal(at.crossings, record.ledger.crossings, same))
        return {};
    std::string words = "makes its volumes otherwise, and meets";
    for (const Crossing& crossing : at.crossings)
        words += fmt::format("{} {:+} at {:.9g}", words.ends_with("meets") ? "" : ",",
                             crossing.change, crossing.depth * unit);
    return words + (at.crossings.empty() ? " none" : "");
}

/// The volumes' casters and far ends in other units.
struct ScaledVolumes {
    Scene casters;
    std::vector<glm::vec3> far_ends;
};

ScaledVolumes scaled(const Volumes& volumes, double unit) {
    ScaledVolumes scaled{volumes.casters(), {}};
    if (const std::vector<glm::vec3>* ends = volumes.far_ends()) scaled.far_ends = *ends;
    if (unit == 1) return scaled;
    for (std::vector<glm::vec3>* positions : {&scaled.casters.positions, &scaled.far_ends})
        for (glm::vec3& position : *positions) position = glm::dvec3(position) * unit;
    return scaled;
}

Json members_of(const CounterAtPixel& at, const Counting& counting, const Volumes& volumes,
                double unit) {
    Json json{{"test", name_of(counting.test)},
              {"operation", name_of(counting.operation)},
              {"start", at.start},
              {"predicted", at.predicted},
              {"stored", at.stored},
              {"read_back", at.read_back},
              {"statuses", Json::array()},
              {"dark_cap", name_of(at.dark_caps)},
              {"dark_caps", at.dark_cap_count}};
    for (const Tally tally : at.tallies) json["statuses"].push_back(name_of(tally));
    if (!counting.casters.empty()) {
        json["tests"] = Json::array();
        for (const Crossing& crossing : at.crossings)
            json["tests"].push_back(name_of(counting.caster(crossing.triangle).test));
    }
    if (!at.other_volumes) return json;
    const ScaledVolumes drawn = scaled(volumes, unit);
    json["crossings"] = Json::array();
    for (Crossing crossing : at.crossings) {
        crossing.depth *= unit;
        json["crossings"].push_back(crossing_json(drawn.casters, crossing, drawn.far_ends));
    }
    return json;
}

/// The depths at which the numbers suffice; null where there are none, and `to` where they have no
/// end.
Json sufficient_json(const SufficientDepths& depths, double unit) {
    if (depths.nearest > depths.furthest) return nullptr;
    Json json{{"from", depths.nearest * unit}, {"to", nullptr}};
    if (std::isfinite(depths.furthest)) json["to"] = depths.furthest * unit;
    return json;
}

} // namespace

Account account_of_counter(const Frame& frame, const Prediction& prediction,
                           const PixelRecord& record, double unit) {
    const Counting& counting = frame.counted->counting;
    const CounterAtPixel at = counter_at(frame, prediction, record);
    const Scene& scene = prediction.volumes().casters();
    const double near = scene.camera.near;
    const SufficientDepths sufficient = sufficient_depths(scene, frame.depth_model);
    Account account;
    account.columns = {{"predicted", std::to_string(at.predicted)},
                       {"stored", std::to_string(at.stored)},
                       {"read back", std::to_string(at.read_back)},
                       {"precise", words_of(sufficient, near, unit)}};
    account.remark = {"lost", lost_words(at, counting, record.ledger.counts.at_eye, unit)};
    account.note = other_volumes_words(at, record, unit);
    Json members = members_of(at, counting, prediction.volumes(), unit);
    members["sufficient"] = sufficient_json(sufficient, unit);
    account.members = members.dump(-1, ' ', false, Json::error_handler_t::replace);
    return account;
}

} // namespace shadowproof
