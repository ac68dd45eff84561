#include "scenes/plan/caster_plan.h"

#include "scenes/driver.h"
#include "scenes/mesh/topology.h"
#include "scenes/mesh/union_find.h"
#include "scenes/plan/beam.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <utility>

namespace shadowproof {

namespace {

/// Comparisons of a triangle with a corner, in total: a tenth of a second.
constexpr std::size_t most_comparisons = std::size_t{1} << 24U;
constexpr std::size_t comparisons_of_boxes = 64; ///< the cost of comparing two boxes

/// How many comparisons are left.
class Effort {
public:
    /// Takes that many comparisons, if they are left.
    bool spend(std::size_t comparisons) {
        if (comparisons > left_) return false;
        left_ -= comparisons;
        return true;
    }

private:
    std::size_t left_ = most_comparisons;
};

/// A triangle's plane, and on which side of it points certainly lie: the sign of (b - a) x (c - a)
/// . (l - w a) for a homogeneous point (l, w), w being 0 or 1. With u = 2^-53, a difference is
/// rounded once, a product of three four times with its factors' own roundings, and two sums on
/// top: each of the six products is off by less than 16 u of its size. Products of zeros are exact,
/// and so is a point in the plane y = 0 beside a triangle in it.
class CertainPlane {
public:
    explicit CertainPlane(const TriangleCorners& t) : corners_(t) {
        constexpr double rounding = 16 * double_roundoff;
        const glm::dvec3 b = t[1] - t[0];
        const glm::dvec3 c = t[2] - t[0];
        const glm::dvec3 size_b = glm::abs(b);
        const glm::dvec3 size_c = glm::abs(c);
        normal_ = glm::cross(b, c);
        error_ = rounding * glm::dvec3(size_b.y * size_c.z + size_b.z * size_c.y,
                                       size_b.z * size_c.x + size_b.x * size_c.z,
                                       size_b.x * size_c.y + size_b.y * size_c.x);
    }

    /// Zero where it is exactly zero, NaN where it is uncertain.
    double side(const glm::dvec4& point) const {
        const glm::dvec3 p = glm::dvec3(point) - point.w * corners_[0];
        const double value = glm::dot(normal_, p);
        const double error = glm::dot(error_, glm::abs(p));
        if (std::abs(value) > error) return value;
        return error == 0 ? 0 : std::numeric_limits<double>::quiet_NaN();
    }
    double side(const glm::dvec3& point) const {
        for (const glm::dvec3& own : corners_)
            if (point == own) return 0;
        return side(glm::dvec4(point, 1));
    }

private:
    TriangleCorners corners_;
    glm::dvec3 normal_{0, 0, 0};
    glm::dvec3 error_{0, 0, 0}; ///< of a product with the normal, per component
};

/// A set of triangles, each of their corners once, and their bounding box.
struct Body {
    std::vector<std::uint32_t> triangles;
    std::vector<std::uint32_t> corners; ///< indices into Scene::positions
    glm::dvec3 low{0, 0, 0};
    glm::dvec3 high{0, 0, 0};
    Beam beam; ///< from the light to the box; of receivers
    bool empty() const { return triangles.empty(); }
};

Body body_of(const Scene& scene, std::vector<std::uint32_t> triangles) {
    Body body;
    body.triangles = std::move(triangles);
    if (body.empty()) return body;
    for (const std::uint32_t triangle : body.triangles)
        for (int k = 0; k < 3; ++k) body.corners.push_back(scene.triangles[triangle][k]);
    std::sort(body.corners.begin(), body.corners.end());
    body.corners.erase(std::unique(body.corners.begin(), body.corners.end()), body.corners.end());
    body.low = body.high = scene.positions[body.corners.front()];
    for (const std::uint32_t corner : body.corners) {
        body.low = glm::min(body.low, glm::dvec3(scene.positions[corner]));
        body.high = glm::max(body.high, glm::dvec3(scene.positions[corner]));
    }
    return body;
}

/// Whether the lit side of a triangle may be seen in the picture.
bool may_show_lit_side(const Scene& scene, std::uint32_t triangle, bool double_sided,
                       const PictureCone& cone) {
    const TriangleCorners corners = corners_of(scene, triangle);
    const CertainPlane plane(corners);
    const double of_light = plane.side(homogeneous(chosen_light(scene)));
    const double of_eye = plane.side(homogeneous_eye(scene.camera));
    if (of_light == 0 || of_eye == 0 || of_light * of_eye < 0) return false;
    if (!double_sided && of_eye < 0) return false;
    return may_be_in_picture(scene.camera, cone, corners);
}

/// The triangles of a mesh that may be seen lit where nothing shadows them. Only they can receive a
/// shadow.
Body lit_body(const Scene& scene, const Mesh& mesh, const PictureCone& cone, double largest) {
    std::vector<std::uint32_t> triangles;
    if (!mesh.receives) return {};
    const bool double_sided = scene.materials[mesh.material].double_sided;
    for (const std::uint32_t triangle : triangles_of(mesh))
        if (may_show_lit_side(scene, triangle, double_sided, cone)) triangles.push_back(triangle);
    Body body = body_of(scene, std::move(triangles));
    if (!body.empty()) body.beam = beam_to_box(scene, largest, body.low, body.high);
    return body;
}

/// Whether a plane across a coordinate axis separates them: the caster on or behind it, the
/// receiver on it or before it, the light before it. Only numbers as given are compared.
bool is_box_behind(const Body& caster, const Body& receiver, const glm::dvec4& light) {
    for (int axis = 0; axis < 3; ++axis)
        for (const int sign : {-1, 1}) {
            const double plane = sign > 0 ? caster.high[axis] : -caster.low[axis];
            const double nearest = sign > 0 ? receiver.low[axis] : -receiver.high[axis];
            const double beyond = sign * light[axis] - light.w * plane;
            if ((beyond > 0 && nearest >= plane) || (beyond >= 0 && nearest > plane)) return true;
        }
    return false;
}

/// Whether the beam from the light to the receiver's box misses the caster's box.
bool is_box_beside(const Body& caster, const Body& receiver) {
    constexpr std::array<glm::dvec3, 3> axes{glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0),
                                             glm::dvec3(0, 0, 1)};
    std::vector<glm::dvec3> corners;
    for (const double x : {caster.low.x, caster.high.x})
        for (const double y : {caster.low.y, caster.high.y})
            for (const double z : {caster.low.z, caster.high.z}) corners.emplace_back(x, y, z);
    return !may_meet(receiver.beam, corners, axes);
}

/// Whether each triangle of `planes` certainly has the light on one side, and all corners of
/// `others` on that side (`on_light_side`) or on the other side, or in its plane.
bool all_on_side(const Scene& scene, const Body& planes, const Body& others,
                 const glm::dvec4& light, bool on_light_side) {
    return std::all_of(
        planes.triangles.begin(), planes.triangles.end(), [&](std::uint32_t triangle) {
            const CertainPlane plane(corners_of(scene, triangle));
            const double of_light = plane.side(light);
            if (of_light == 0) return true; // no segment to the light crosses it
            if (std::isnan(of_light)) return false;
            const double sign = (of_light > 0) == on_light_side ? 1 : -1;
            return std::all_of(
                others.corners.begin(), others.corners.end(), [&](std::uint32_t corner) {
                    return sign * plane.side(glm::dvec3(scene.positions[corner])) >= 0;
                });
        });
}

/// Whether a caster may lie between the light and some point of a receiver's lit sides. It does not
/// where it lies entirely behind each of those sides, as a convex body does behind its own; nor
/// where the receiver and the light lie before each of the caster's planes, as in a room.
bool may_shadow(const Scene& scene, const Body& caster, const Body& receiver,
                const glm::dvec4& light, Effort& effort) {
    if (!effort.spend(comparisons_of_boxes)) return true;
    if (is_box_behind(caster, receiver, light) || is_box_beside(caster, receiver)) return false;
    if (effort.spend(caster.triangles.size() * receiver.corners.size()) &&
        all_on_side(scene, caster, receiver, light, true))
        return false;
    return !effort.spend(receiver.triangles.size() * caster.corners.size()) ||
           !all_on_side(scene, receiver, caster, light, false);
}

/// All points that may lie between the light and the visible surfaces: the picture's pyramid, as
/// deep as the scene.
Beam beam_to_seen(const Scene& scene, double largest) {
    double deepest = scene.camera.near;
    for (const glm::dvec3 position : scene.positions)
        deepest = std::max(deepest, view_depth(scene.camera, position));
    return beam_to_pyramid(scene, largest, std::min(deepest, scene.camera.far));
}

bool body_may_meet(const Scene& scene, const Body& body, const Beam& beam) {
    return std::any_of(body.triangles.begin(), body.triangles.end(), [&](std::uint32_t triangle) {
        return may_meet(beam, corners_of(scene, triangle));
    });
}

/// Why no visible surface can lie in a caster's shadow; empty where one may.
std::string reason_to_leave_out(const Scene& scene, const Body& caster,
                                const std::vector<Body>& receivers, const Beam& to_seen,
                                Effort& effort) {
    if (caster.empty()) return "it has no triangles";
    if (!body_may_meet(scene, caster, to_seen)) return "the shadow falls outside the picture";
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    const bool shadows = std::any_of(receivers.begin(), receivers.end(), [&](const Body& receiver) {
        return !receiver.empty() && may_shadow(scene, caster, receiver, light, effort);
    });
    return shadows ? "" : "nothing seen lies behind, as the light looks";
}

/// The first mesh of the body that each mesh belongs to: meshes that share a corner are one.
std::vector<std::uint32_t> first_of_body(const Scene& scene) {
    const std::vector<std::uint32_t> welded = weld_by_position(scene.positions);
    UnionFind bodies(scene.meshes.size());
    constexpr std::uint32_t none = 0xffffffffU;
    std::vector<std::uint32_t> owner(scene.positions.size(), none);
    for (std::uint32_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
        if (!scene.meshes[mesh].casts) continue;
        for (const std::uint32_t triangle : triangles_of(scene.meshes[mesh]))
            for (int k = 0; k < 3; ++k) {
                std::uint32_t& first = owner[welded[scene.triangles[triangle][k]]];
                if (first == none) first = mesh;
                bodies.unite(first, mesh);
            }
    }
    std::vector<std::uint32_t> first_of(scene.meshes.size());
    for (std::uint32_t mesh = 0; mesh < first_of.size(); ++mesh) first_of[mesh] = bodies.find(mesh);
    return first_of;
}

/// Whether the eye certainly sees the front of a triangle wherever its corners are snapped to. a, b
/// and c are relative to the eye and moved by up to `da`, `db` and `dc`: the determinant a . (b x
/// c) is negative by more than that can change.
bool is_front_certain(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, double da,
                      double db, double dc) {
    const double la = glm::length(a);
    const double lb = glm::length(b);
    const double lc = glm::length(c);
    const double once = da * glm::length(glm::cross(b, c)) + db * glm::length(glm::cross(c, a)) +
                        dc * glm::length(glm::cross(a, b));
    const double twice = da * db * lc + db * dc * la + dc * da * lb;
    return -glm::dot(a, glm::cross(b, c)) > once + twice + da * db * dc;
}

/// The same along parallel lines of sight, with corners moved by up to `moved`: each edge changes
/// by twice that.
bool is_front_certain(const glm::dvec3& forward, const TriangleCorners& corners, double moved) {
    const glm::dvec3 ab = corners[1] - corners[0];
    const glm::dvec3 ac = corners[2] - corners[0];
    const double by = 2 * moved;
    return -glm::dot(forward, glm::cross(ab, ac)) > by * (glm::length(ab) + glm::length(ac) + by);
}

} // namespace

std::vector<CasterPlan> plan_casters(const Scene& scene) {
    const PictureCone cone = picture_cone(scene);
    const double largest = largest_position(scene);
    const Beam to_seen = beam_to_seen(scene, largest);
    const Beam to_near = beam_to_pyramid(scene, largest, scene.camera.near);
    const PictureCone to_eye = opposite(cone);
    std::vector<Body> receivers;
    for (const Mesh& mesh : scene.meshes) receivers.push_back(lit_body(scene, mesh, cone, largest));
    Effort effort;

    const Light& light = chosen_light(scene);
    const auto reaches_infinity = [&](std::uint32_t triangle) {
        return light.kind != Light::Kind::directional &&
               may_point_into(cone, corners_of(scene, triangle), light.position);
    };
    // An eye at infinity may be in a volume that never meets the near plane.
    const auto reaches_eye = [&](std::uint32_t triangle) {
        if (!scene.camera.is_orthographic()) return false;
        const glm::dvec4 from = homogeneous(light);
        if (from.w != 0) return may_point_into(to_eye, corners_of(scene, triangle), from);
        const glm::dvec3 away = -glm::dvec3(from);
        return may_point_into(to_eye, {away, away, away}, glm::dvec3(0));
    };
    std::vector<CasterPlan> plans;
    for (std::uint32_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
        if (!scene.meshes[mesh].casts) continue;
        const Body caster = body_of(scene, triangles_of(scene.meshes[mesh]));
        CasterPlan& plan = plans.emplace_back();
        plan.mesh = mesh;
        plan.left_out = reason_to_leave_out(scene, caster, receivers, to_seen, effort);
        plan.meets_near = body_may_meet(scene, caster, to_near) ||
                          std::ranges::any_of(caster.triangles, reaches_eye);
        plan.reaches_infinity =
            std::any_of(caster.triangles.begin(), caster.triangles.end(), reaches_infinity);
    }

    const std::vector<std::uint32_t> body = first_of_body(scene);
    std::vector<CasterPlan> of_body(scene.meshes.size());
    for (CasterPlan& all : of_body) all.meets_near = all.reaches_infinity = false;
    for (const CasterPlan& plan : plans) {
        if (!plan.left_out.empty()) continue;
        CasterPlan& all = of_body[body[plan.mesh]];
        all.meets_near |= plan.meets_near;
        all.reaches_infinity |= plan.reaches_infinity;
    }
    for (CasterPlan& plan : plans) {
        if (!plan.left_out.empty()) continue;
        const CasterPlan& all = of_body[body[plan.mesh]];
        plan.meets_near = all.meets_near;
        plan.reaches_infinity = all.reaches_infinity;
    }
    return plans;
}

// A corner is snapped to a grid of at least 4 bits per pixel (OpenGL's least GL_SUBPIXEL_BITS), by
// half a step along both axes, and transformed in floats with PictureCone's error.
std::vector<std::uint8_t> certain_surfaces(const Scene& scene, bool far_clips) {
    const Camera& camera = scene.camera;
    const double error = picture_cone(scene).error;
    const double half_step = std::sqrt(2.0) / 32;
    const double snapping = half_step * 2 * camera.half_height / camera.height;
    const bool is_parallel = camera.is_orthographic();
    std::vector<std::uint8_t> certain(scene.triangles.size(), 0);
    for (const Mesh& mesh : scene.meshes) {
        if (scene.materials[mesh.material].mask != no_mask) continue;
        const bool double_sided = scene.materials[mesh.material].double_sided;
        for (const std::uint32_t triangle : triangles_of(mesh)) {
            const TriangleCorners corners = corners_of(scene, triangle);
            glm::dvec3 depth{0, 0, 0};
            for (int k = 0; k < 3; ++k)
                depth[k] = view_depth(camera, corners[static_cast<std::size_t>(k)]);
            const double nearest = std::min({depth.x, depth.y, depth.z});
            const double deepest = std::max({depth.x, depth.y, depth.z});
            if (!far_clips && deepest + error >= camera.far) continue;
            if (!double_sided && nearest - error <= camera.near)
                continue; // what is left is clipped
            const glm::dvec3 moved = depth * snapping + error;
            const bool is_front =
                is_parallel ? is_front_certain(camera.forward, corners, snapping + error)
                            : is_front_certain(corners[0] - camera.eye, corners[1] - camera.eye,
                                               corners[2] - camera.eye, moved.x, moved.y, moved.z);
            if (double_sided || is_front) certain[triangle] = 1;
        }
    }
    return certain;
}

} // namespace shadowproof
