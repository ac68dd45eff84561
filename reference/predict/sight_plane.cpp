#include "reference/predict/sight_plane.h"

#include "reference/trace/faces.h"

#include <glm/geometric.hpp>

namespace shadowproof {

namespace {

/// d x m, not normalised, where m is the direction in which the eye is moved to break ties
/// (Predicates::shadow_edge_untied): (e, e^2, e^3), with an e that distinguishes the three whatever
/// the sizes in d, and that no rounding reaches.
glm::dvec3 cross_with_move(const glm::dvec3& d) {
    constexpr double e = 0x1p-60;
    glm::dvec3 sum(0);
    double weight = 1;
    for (const glm::dvec3& part :
         {glm::dvec3(0, d.z, -d.y), glm::dvec3(-d.z, 0, d.x), glm::dvec3(d.y, -d.x, 0)}) {
        if (part == glm::dvec3(0)) continue;
        sum += part * (weight / largest(part));
        weight *= e;
    }
    return sum;
}

/// v times a power of two that keeps products of it far from the smallest doubles.
glm::dvec3 enlarged(const glm::dvec3& v) {
    return largest(v) < 0x1p-500 ? v * 0x1p500 : v;
}

/// Of an eye at infinity: the plane with this normal through p.
SightPlane plane_at(const glm::dvec3& normal, const glm::dvec3& p) {
    return {normal, -glm::dot(p, normal)};
}

} // namespace

// The eye at infinity, -D, moves by -m (predicates.h).
SightPlane plane_through_eye(const Camera& camera, const glm::dvec3& v, const glm::dvec3& p) {
    const bool is_parallel = camera.is_orthographic();
    const glm::dvec3 to_eye = is_parallel ? -camera.forward : camera.eye - p;
    glm::dvec3 normal = glm::cross(enlarged(v), enlarged(to_eye));
    if (normal == glm::dvec3(0)) normal = is_parallel ? -cross_with_move(v) : cross_with_move(v);
    return is_parallel ? plane_at(normal, p) : SightPlane{normal, 0};
}

// If the eye lies on the edge's line: (a - e m) x (b - e m), e -> 0, is e (b - a) x m. Parallel
// lines of sight: D . (a - S) x (b - S) is (S - a) . D x (b - a).
SightPlane edge_plane(const Camera& camera, const glm::dvec3& a, const glm::dvec3& b) {
    if (before(b, a)) return edge_plane(camera, b, a);
    if (camera.is_orthographic()) {
        const glm::dvec3 along = enlarged(b - a);
        const glm::dvec3 normal = glm::cross(camera.forward, along);
        return plane_at(normal == glm::dvec3(0) ? -cross_with_move(along) : normal, a);
    }
    const glm::dvec3 normal = glm::cross(enlarged(a - camera.eye), enlarged(b - camera.eye));
    return {normal == glm::dvec3(0) ? cross_with_move(b - a) : normal, 0};
}

} // namespace shadowproof
