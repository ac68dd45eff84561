#include "scenes/plan/plan.h"

#include "scenes/mesh/counted_casters.h"
#include "scenes/mesh/topology.h"
#include "scenes/mesh/touching_light.h"
#include "scenes/plan/beam.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace shadowproof {

double finite_far(const Scene& scene) {
    if (std::isfinite(scene.camera.far)) return scene.camera.far;
    double deepest = 0;
    for (const glm::dvec3 position : scene.positions)
        deepest = std::max(deepest, view_depth(scene.camera, position));
    const double far = std::max(1.5 * deepest, 2 * scene.camera.near);
    // An orthographic camera's near plane may be where it stands, and all be behind it.
    return far > scene.camera.near ? far : scene.camera.near + scene.camera.half_height;
}

namespace {

/// Whether `holds` is true of some triangle that casts.
template <class Holds>
bool some_caster(const Scene& scene, const Holds& holds) {
    const std::vector<std::uint8_t> casts = casting_triangles(scene);
    for (std::uint32_t triangle = 0; triangle < scene.triangles.size(); ++triangle)
        if (casts[triangle] != 0 && holds(corners_of(scene, triangle))) return true;
    return false;
}

/// Whether some volume may contain a point of the picture at view depth `depth`. The volume of a
/// triangle contains Q when the line from Q to the light meets the triangle.
bool volume_meets(const Scene& scene, double depth) {
    const Beam beam = beam_to_rectangle(scene, largest_position(scene), depth);
    return some_caster(scene,
                       [&](const TriangleCorners& corners) { return may_meet(beam, corners); });
}

/// Whether some volume may be seen at infinity. All volumes of a directional light converge to one
/// point there, where a cap covers nothing.
bool volume_reaches_infinity(const Scene& scene) {
    const Light& light = chosen_light(scene);
    if (light.kind == Light::Kind::directional) return false;
    const PictureCone cone = picture_cone(scene);
    return some_caster(scene, [&](const TriangleCorners& corners) {
        return may_point_into(cone, corners, light.position);
    });
}

/// A scan may consist of thousands of open pieces: this many are listed, the others only counted.
constexpr std::size_t most_faults = 20;

std::vector<std::string> list_faults(const Scene& scene, const std::vector<CasterReport>& reports) {
    std::vector<std::string> faults;
    for (const CasterReport& report : reports)
        if (std::string words = words_of(scene, report); !words.empty())
            faults.push_back(std::move(words));
    if (faults.size() <= most_faults) return faults;
    const std::size_t unlisted = faults.size() - most_faults;
    faults.resize(most_faults);
    faults.push_back(
        fmt::format("{} more casters are open, inverted or not two-manifold", unlisted));
    return faults;
}

/// One line per mesh.
std::vector<std::string> list_touching(const Scene& scene) {
    std::map<std::uint32_t, int> triangles; // by mesh
    for (const std::uint32_t triangle : triangles_touching_light(scene))
        ++triangles[mesh_of(scene, triangle)];
    std::vector<std::string> lines;
    for (const auto& [mesh, count] : triangles)
        lines.push_back(fmt::format(
            "caster '{}' touches the light with {} triangle{}: a renderer that throws its volume "
            "away from the light corner by corner may darken either half of the world; move the "
            "light off it",
            scene.meshes[mesh].name, count, count == 1 ? "" : "s"));
    return lines;
}

} // namespace

Plan make_plan(const Scene& scene) {
    Plan plan;
    if (!is_bump_lit(scene)) plan.left_out.push_back("tangents: no normal map or height field");
    const std::vector<CasterReport> casters = inspect_casters(scene);
    plan.faults = list_faults(scene, casters);
    for (std::string& line : list_touching(scene)) plan.faults.push_back(std::move(line));
    plan.hole_filling = !std::all_of(casters.begin(), casters.end(),
                                     [](const CasterReport& c) { return c.encloses_volume(); });
    if (!plan.hole_filling) plan.left_out.push_back("hole filling: every caster is closed");
    plan.around_light = triangles_around_light(scene);
    if (plan.around_light.empty())
        plan.left_out.push_back("flipping casters: none has the light inside");
    plan.volume_meets_near = volume_meets(scene, scene.camera.near);
    if (!plan.volume_meets_near)
        plan.left_out.push_back("near cap: no volume meets the near plane, z-pass is enough");
    plan.volume_meets_far = volume_meets(scene, finite_far(scene));
    if (!plan.volume_meets_far)
        plan.left_out.push_back("depth clamp: no volume meets the far plane");
    plan.dark_cap = volume_reaches_infinity(scene);
    if (!plan.dark_cap) plan.left_out.push_back("dark cap: no volume is seen to infinity");
    return plan;
}

} // namespace shadowproof
