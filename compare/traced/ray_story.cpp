#include "compare/traced/ray_story.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace shadowproof {

namespace {

using Json = nlohmann::ordered_json;

Json point(const glm::dvec3& p) {
    return {p.x, p.y, p.z};
}

std::string_view name_of(RayModel::Start start) {
    switch (start) {
    case RayModel::Start::epsilon:
        return "epsilon";
    case RayModel::Start::offset:
        return "offset";
    case RayModel::Start::skip:
        break;
    }
    return "skip";
}

/// A triangle and where on the ray, or null.
Json met(const Scene& scene, std::uint32_t triangle, double t) {
    if (triangle == no_triangle) return nullptr;
    return {
        {"triangle", triangle}, {"mesh", scene.meshes[mesh_of(scene, triangle)].name}, {"t", t}};
}

std::string hit_words(const TracedClaim& claim, const ExactHit& hit, double unit) {
    return fmt::format("triangle {} of {} at {:.9g}{}", hit.triangle,
                       claim.scene().meshes[mesh_of(claim.scene(), hit.triangle)].name,
                       hit.t * unit, hit.is_own ? ", its own surface" : "");
}

/// "starts at (...) and meets ..., its own surface"
std::string story(const TracedClaim& claim, PixelPlace p, const ExactRays& exact, double unit) {
    const TracedPixel& pixel = claim.pixel(p);
    if (!pixel.shot) return "shot no shadow ray";
    const glm::dvec3 start = glm::dvec3(pixel.shadow.origin) * unit;
    std::string words =
        fmt::format("shot a shadow ray from ({:.9g}, {:.9g}, {:.9g}), beyond {:.9g}", start.x,
                    start.y, start.z, pixel.shadow.near * unit);
    if (exact.leaves_at)
        words += fmt::format(", from behind its receiver's plane, which it leaves at {:.9g}",
                             *exact.leaves_at * unit);
    words += exact.hits.empty()
                 ? "; traced exactly, it meets nothing"
                 : "; traced exactly, it first meets " + hit_words(claim, exact.hits.front(), unit);
    if (exact.passed_over)
        words += "; it passes over " + hit_words(claim, *exact.passed_over, unit);
    return words;
}

Json shadow_members(const TracedClaim& claim, PixelPlace p, const ExactRays& exact, double unit) {
    const Scene& scene = claim.scene();
    const TracedPixel& pixel = claim.pixel(p);
    const FloatRay& ray = pixel.shadow;
    Json json{{"origin", point(glm::dvec3(ray.origin) * unit)},
              {"direction", point(ray.direction)},
              {"near", ray.near * unit},
              {"far", std::isinf(ray.far) ? Json(nullptr) : Json(ray.far * unit)},
              {"stopped_by", pixel.occluder == no_triangle ? Json(nullptr) : Json(pixel.occluder)},
              {"leaves_plane_at", exact.leaves_at ? Json(*exact.leaves_at * unit) : Json(nullptr)},
              {"hits", Json::array()}};
    for (const ExactHit& hit : exact.hits) {
        Json each = met(scene, hit.triangle, hit.t * unit);
        each["own_surface"] = hit.is_own;
        json["hits"].push_back(each);
    }
    json["passed_over"] = exact.passed_over
                              ? met(scene, exact.passed_over->triangle, exact.passed_over->t * unit)
                              : Json(nullptr);
    return json;
}

} // namespace

Account account_of_rays(const TracedClaim& claim, PixelPlace p, RayFault fault, double unit) {
    const TracedPixel& pixel = claim.pixel(p);
    Account account;
    const auto triangle = [](std::uint32_t index) {
        return index == no_triangle ? std::string("-") : std::to_string(index);
    };
    const bool sees = pixel.seen != no_triangle;
    const FloatRay eye_ray = claim.rays().eye_ray(pixel.line);
    account.columns = {{"saw", triangle(pixel.seen)},
                       {"at", sees ? fmt::format("{:.9g}", pixel.depth * unit) : "-"},
                       {"stopped by", triangle(pixel.occluder)}};
    Json json{{"model", name_of(claim.rays().model.start)},
              {"distance", claim.rays().model.distance * unit},
              {"saw", pixel.seen == no_triangle ? Json(nullptr) : Json(pixel.seen)},
              {"at", sees ? Json(pixel.depth * unit) : Json(nullptr)},
              {"eye_ray",
               {{"origin", point(glm::dvec3(eye_ray.origin) * unit)},
                {"direction", point(eye_ray.direction)}}}};
    if (fault.empty()) {
        const ExactRays exact = trace_exactly(claim, p);
        account.columns.push_back({"exactly", exact.hits.empty()
                                                  ? std::string("-")
                                                  : triangle(exact.hits.front().triangle)});
        account.note = story(claim, p, exact, unit);
        json["sees_exactly"] = exact.seen == no_triangle ? Json(nullptr) : Json(exact.seen);
        json["shadow_ray"] = pixel.shot ? shadow_members(claim, p, exact, unit) : Json(nullptr);
    } else {
        account.columns.push_back({"exactly", "?"});
        account.note = "is not explained: its " + std::string(fault);
        json["fault"] = fault;
    }
    account.members = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    return account;
}

} // namespace shadowproof
