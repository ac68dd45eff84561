#include "compare/judge/crossing_json.h"

#include <nlohmann/json.hpp>

namespace shadowproof {

using Json = nlohmann::ordered_json;

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

namespace {

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

} // namespace

Json crossing_json(const Scene& scene, const Crossing& crossing,
                   const std::vector<glm::vec3>& ends) {
    return {{"depth", crossing.depth},
            {"change", crossing.change},
            {"kind", kind_of(crossing)},
            {"caster", triangle_json(scene, crossing.triangle)},
            {"from", beginning_json(scene, crossing, ends)}};
}

} // namespace shadowproof
