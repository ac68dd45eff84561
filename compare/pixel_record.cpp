#include "compare/pixel_record.h"

#include "compare/color_words.h"
#include "compare/light_json.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace shadowproof {

namespace {

using Json = nlohmann::ordered_json;

std::optional<double> depth_margin(const PixelLedger& ledger, std::uint32_t seen) {
    if (seen == no_triangle) return std::nullopt;
    double margin = std::numeric_limits<double>::infinity();
    for (const Crossing& crossing : ledger.crossings) {
        const bool own_cap =
            crossing.part == Crossing::Part::light_cap && crossing.triangle == seen;
        if (!own_cap) margin = std::min(margin, std::abs(crossing.depth - ledger.surface));
    }
    if (std::isinf(margin)) return std::nullopt;
    return margin;
}

/// Looked for in growing rings, until no pixel further out can be nearer.
std::optional<double> pixel_margin(const Image<Visibility>& truth, int x, int y) {
    const Visibility own = truth.at(x, y);
    long nearest = std::numeric_limits<long>::max(); // squared
    const auto look = [&](int i, int k) {
        if (i < 0 || k < 0 || i >= truth.width || k >= truth.height || truth.at(i, k) == own)
            return;
        const long dx = i - x;
        const long dy = k - y;
        nearest = std::min(nearest, dx * dx + dy * dy);
    };
    const int widest = std::max(truth.width, truth.height);
    for (int ring = 1; ring < widest && static_cast<long>(ring) * ring < nearest; ++ring)
        for (int i = -ring; i <= ring; ++i) {
            look(x + i, y - ring);
            look(x + i, y + ring);
            look(x - ring, y + i);
            look(x + ring, y + i);
        }
    if (nearest == std::numeric_limits<long>::max()) return std::nullopt;
    return std::sqrt(static_cast<double>(nearest));
}

Json vector_json(const glm::dvec3& v) {
    return Json::array({v.x, v.y, v.z});
}

Json optional_json(const std::optional<double>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json triangle_json(const Scene& scene, std::uint32_t triangle) {
    if (triangle == no_triangle) return nullptr;
    return {{"triangle", triangle}, {"mesh", scene.meshes[mesh_of(scene, triangle)].name}};
}

Json corners_json(const Scene& scene, std::uint32_t triangle) {
    Json corners = Json::array();
    for (int k = 0; k < 3; ++k) corners.push_back(vector_json(corner(scene, triangle, k)));
    return corners;
}

std::string_view kind_of(const Crossing& crossing) {
    if (crossing.is_side()) return "side";
    return crossing.part == Crossing::Part::light_cap ? "light cap" : "dark cap";
}

/// Where a face begins: the ends of the edge that a side stands on, or a cap's corners. `ends`:
/// positions of the far ends.
Json beginning_json(const Scene& scene, const Crossing& crossing,
                    const std::vector<glm::vec3>& ends) {
    if (crossing.part == Crossing::Part::light_cap) return corners_json(scene, crossing.triangle);
    Json corners = Json::array();
    if (crossing.part == Crossing::Part::dark_cap) {
        for (int k = 0; k < 3; ++k)
            corners.push_back(vector_json(glm::dvec3(ends[scene.triangles[crossing.triangle][k]])));
        return corners;
    }
    const int k = static_cast<int>(crossing.part);
    for (const int end : {k, (k + 1) % 3})
        corners.push_back(vector_json(corner(scene, crossing.triangle, end)));
    return corners;
}

Json crossing_json(const Scene& scene, const Crossing& crossing,
                   const std::vector<glm::vec3>& ends) {
    return {{"depth", crossing.depth},
            {"change", crossing.change},
            {"kind", kind_of(crossing)},
            {"caster", triangle_json(scene, crossing.triangle)},
            {"from", beginning_json(scene, crossing, ends)}};
}

Json technique_json(const Scene& scene, const TechniqueAtPixel& technique) {
    if (!technique.error.empty()) return {{"name", technique.name}, {"error", technique.error}};
    Json json{{"name", technique.name},
              {"test", name_of(technique.counting.test)},
              {"operation", name_of(technique.counting.operation)},
              {"start", technique.start},
              {"predicted", technique.predicted},
              {"stored", technique.stored},
              {"read_back", technique.read_back},
              {"claim", name_of(technique.claim)},
              {"shown", triangle_json(scene, technique.shown)},
              {"cause", technique.cause == no_difference ? Json(nullptr)
                                                         : Json(all_causes[technique.cause].name)},
              {"statuses", Json::array()},
              {"dark_cap", name_of(technique.dark_caps)},
              {"dark_caps", technique.dark_cap_count}};
    if (technique.color) json["color"] = to_json(*technique.color);
    for (const Tally tally : technique.tallies) json["statuses"].push_back(name_of(tally));
    if (!technique.tests.empty()) {
        json["tests"] = Json::array();
        for (const Counting::Test test : technique.tests) json["tests"].push_back(name_of(test));
    }
    if (!technique.crossings) return json;
    json["crossings"] = Json::array();
    for (const Crossing& crossing : *technique.crossings)
        json["crossings"].push_back(crossing_json(technique.casters, crossing, technique.far_ends));
    return json;
}

} // namespace

std::string_view name_of(Visibility visibility) {
    switch (visibility) {
    case Visibility::lit:
        return "lit";
    case Visibility::shadowed:
        return "shadowed";
    case Visibility::background:
        break;
    }
    return "background";
}

std::string_view name_of(Exactness exactness) {
    switch (exactness) {
    case Exactness::filtered:
        return "filtered";
    case Exactness::exact:
        return "exact";
    case Exactness::degenerate:
        break;
    }
    return "degenerate";
}

PixelRecord record_pixel(const Tracer& tracer, const GroundTruth& truth, const ShadowDepths& depths,
                         int x, int y) {
    PixelRecord record;
    record.x = x;
    record.y = y;
    record.direction = ray_direction(tracer.scene().camera, x + 0.5, y + 0.5);
    record.visibility = truth.visibility.at(x, y);
    record.exactness = truth.exactness.at(x, y);
    record.seen = truth.triangle.at(x, y);
    if (record.seen != no_triangle)
        record.faces_light = sides_of(tracer, record.seen).faces_light();
    const RayTruth truth_again = trace_ray(tracer, record.direction);
    record.in_cone = truth_again.in_cone;
    record.occluder = truth_again.occluder;
    record.far = depths.far;
    record.ledger = pixel_ledger(tracer, truth, depths, x, y);
    record.depth_margin = depth_margin(record.ledger, record.seen);
    record.pixel_margin = pixel_margin(truth.visibility, x, y);
    return record;
}

TechniqueAtPixel technique_at(const PixelRecord& record, const Prediction& prediction,
                              std::string name, const Frame& frame, const Comparison& comparison) {
    const int x = record.x;
    const int y = record.y;
    TechniqueAtPixel technique;
    technique.name = std::move(name);
    technique.counting = frame.counting;
    technique.start =
        start_of(frame.counting, prediction.depths().at_eye, prediction.depths().at_near.at(x, y));
    technique.predicted = prediction.counts().at(x, y);
    technique.stored = comparison.predicted.at(x, y);
    technique.read_back = frame.counter.at(x, y);
    technique.claim = frame.claim.at(x, y);
    technique.shown = frame.triangle.at(x, y);
    technique.cause = comparison.cause.at(x, y);
    if (const Volumes& volumes = prediction.volumes(); !volumes.are_the_casters()) {
        RegionLedger ledger =
            volumes.ledger(corner_rays(volumes.casters().camera, x, y, x + 1, y + 1));
        ledger.crossings(record.direction, technique.crossings.emplace());
        technique.casters = volumes.casters();
        if (const std::vector<glm::vec3>* ends = volumes.far_ends()) technique.far_ends = *ends;
    }
    if (!frame.counting.casters.empty())
        for (const Crossing& crossing : crossings_of(record, technique))
            technique.tests.push_back(frame.counting.caster(crossing.triangle).test);
    for (const Crossing& crossing : crossings_of(record, technique))
        technique.tallies.push_back(tally(crossing, record.ledger.surface, record.seen, record.far,
                                          frame.counting, frame.depth_model));
    technique.dark_caps = tally_of_dark_caps(frame.counting, frame.depth_model);
    technique.dark_cap_count = dark_caps_at_infinity(frame.counting, prediction.depths().at_eye,
                                                     crossings_of(record, technique));
    return technique;
}

PixelRecord in_units(PixelRecord record, double unit) {
    if (unit == 1) return record;
    const auto scale = [&](std::vector<Crossing>& crossings) {
        for (Crossing& crossing : crossings) crossing.depth *= unit;
    };
    record.far *= unit;
    record.ledger.surface *= unit;
    scale(record.ledger.crossings);
    if (record.depth_margin) *record.depth_margin *= unit;
    for (TechniqueAtPixel& technique : record.techniques) {
        if (technique.crossings) scale(*technique.crossings);
        for (std::vector<glm::vec3>* positions :
             {&technique.casters.positions, &technique.far_ends})
            for (glm::vec3& position : *positions) position = glm::dvec3(position) * unit;
    }
    return record;
}

nlohmann::ordered_json to_json(const Scene& scene, const PixelRecord& record) {
    const Camera& camera = scene.camera;
    const RayCounts& counts = record.ledger.counts;
    const bool seen = record.seen != no_triangle;
    Json json{{"schema", "shadowproof/pixel/1"},
              {"scene", scene.name},
              {"x", record.x},
              {"y", record.y},
              {"width", camera.width},
              {"height", camera.height},
              {"eye", vector_json(camera.eye)},
              {"direction", vector_json(record.direction)},
              {"near", camera.near},
              {"far", record.far},
              {"light", light_json(chosen_light(scene))},
              {"truth", name_of(record.visibility)},
              {"exactness", name_of(record.exactness)},
              {"seen", triangle_json(scene, record.seen)},
              {"occluder", triangle_json(scene, record.occluder)},
              {"margin",
               {{"depth", optional_json(record.depth_margin)},
                {"pixels", optional_json(record.pixel_margin)}}},
              {"inside",
               {{"eye", counts.at_eye},
                {"near", counts.at_near},
                {"surface", seen ? Json(counts.at_surface) : Json(nullptr)},
                {"far", counts.at_far},
                {"infinity", counts.at_infinity}}},
              {"crossings", Json::array()},
              {"adds_up", record.ledger.adds_up},
              {"notes", scene.notes},
              {"techniques", Json::array()}};
    if (seen) {
        const double depth = record.ledger.surface;
        json["seen"]["depth"] = depth;
        json["seen"]["point"] = vector_json(camera.eye + depth * record.direction);
        json["seen"]["corners"] = corners_json(scene, record.seen);
        json["seen"]["faces_light"] = record.faces_light;
        if (chosen_light(scene).kind == Light::Kind::spot) json["seen"]["in_cone"] = record.in_cone;
    }
    for (const Crossing& crossing : record.ledger.crossings)
        json["crossings"].push_back(crossing_json(scene, crossing, {}));
    for (const TechniqueAtPixel& technique : record.techniques)
        json["techniques"].push_back(technique_json(scene, technique));
    return json;
}

} // namespace shadowproof
