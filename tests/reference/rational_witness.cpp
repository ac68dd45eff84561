#include "tests/reference/rational_witness.h"

#include <cmath>

namespace shadowproof::witness {

namespace {

Point point(const glm::dvec3& p) {
    return {mpq_class(p.x), mpq_class(p.y), mpq_class(p.z)};
}

Point minus(const Point& p, const Point& q) {
    return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}

Point along(const Point& p, const mpq_class& t, const Point& d) {
    return {p[0] + t * d[0], p[1] + t * d[1], p[2] + t * d[2]};
}

mpq_class dot(const Point& p, const Point& q) {
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}

Point cross(const Point& p, const Point& q) {
    return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}

/// A point of the plane against the triangle, closed.
bool inside(const Plane& t, const Point& p) {
    return sgn(dot(cross(minus(t.b, t.a), minus(p, t.a)), t.normal)) >= 0 &&
           sgn(dot(cross(minus(t.c, t.b), minus(p, t.b)), t.normal)) >= 0 &&
           sgn(dot(cross(minus(t.a, t.c), minus(p, t.c)), t.normal)) >= 0;
}

/// Where the line p + s d meets the plane; nothing where it runs along it.
std::optional<mpq_class> meet(const Plane& t, const Point& p, const Point& d) {
    if (!t.has_area) return std::nullopt;
    const mpq_class slope = dot(t.normal, d);
    if (sgn(slope) == 0) return std::nullopt;
    return mpq_class(dot(t.normal, minus(t.a, p)) / slope);
}

} // namespace

Witness::Witness(const Scene& scene)
    : eye_(point(scene.camera.eye)), light_(point(chosen_light(scene).position)),
      near_(scene.camera.near) {
    if (std::isfinite(scene.camera.far)) far_ = mpq_class(scene.camera.far);
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
        Plane t;
        t.a = point(corner(scene, i, 0));
        t.b = point(corner(scene, i, 1));
        t.c = point(corner(scene, i, 2));
        t.normal = cross(minus(t.b, t.a), minus(t.c, t.a));
        t.has_area = sgn(dot(t.normal, t.normal)) != 0;
        for (const Mesh& mesh : scene.meshes)
            if (i >= mesh.first_triangle && i < mesh.first_triangle + mesh.triangle_count)
                t.seen_from_behind = scene.materials[mesh.material].double_sided;
        planes_.push_back(t);
    }
}

Point Witness::on_ray(const glm::dvec3& direction, double depth) const {
    return along(eye_, mpq_class(depth), point(direction));
}

int Witness::side_of_eye(std::uint32_t triangle) const {
    return sgn(dot(planes_[triangle].normal, minus(eye_, planes_[triangle].a)));
}

int Witness::side_of_light(std::uint32_t triangle) const {
    return sgn(dot(planes_[triangle].normal, minus(light_, planes_[triangle].a)));
}

bool Witness::occluded(const Point& hit, std::uint32_t own) const {
    const Point to_light = minus(light_, hit);
    for (std::uint32_t i = 0; i < planes_.size(); ++i) {
        if (i == own) continue;
        const std::optional<mpq_class> s = meet(planes_[i], hit, to_light);
        if (s && sgn(*s) > 0 && *s < 1 && inside(planes_[i], along(hit, *s, to_light))) return true;
    }
    return false;
}

Answer Witness::look(const glm::dvec3& direction) const {
    const Point d = point(direction);
    Answer answer;
    std::optional<mpq_class> nearest;
    for (std::uint32_t i = 0; i < planes_.size(); ++i) {
        const std::optional<mpq_class> t = meet(planes_[i], eye_, d);
        if (!t || *t < near_ || (far_ && *t > *far_) || (nearest && *t >= *nearest)) continue;
        if (!planes_[i].seen_from_behind && side_of_eye(i) <= 0) continue;
        if (!inside(planes_[i], along(eye_, *t, d))) continue;
        nearest = t;
        answer.triangle = i;
    }
    if (!nearest) return answer;
    answer.hit = along(eye_, *nearest, d);
    const bool faces = side_of_eye(answer.triangle) * side_of_light(answer.triangle) > 0;
    answer.visibility =
        faces && !occluded(answer.hit, answer.triangle) ? Visibility::lit : Visibility::shadowed;
    return answer;
}

int Witness::shadow_depth(const Point& q, std::uint32_t skip) const {
    const mpq_class e = mpq_class(1) / (mpq_class(1) << 400);
    const Point moved{q[0] + e, q[1] + e * e, q[2] + e * e * e};
    const Point from_light = minus(moved, light_);
    const Point unmoved = minus(q, light_);
    int count = 0;
    for (std::uint32_t i = 0; i < planes_.size(); ++i) {
        if (i == skip || !planes_[i].has_area || side_of_light(i) <= 0) continue;
        const std::optional<mpq_class> still = meet(planes_[i], light_, unmoved);
        if (!still || sgn(*still) <= 0 || *still >= 1) continue;
        const std::optional<mpq_class> s = meet(planes_[i], light_, from_light);
        count += s && inside(planes_[i], along(light_, *s, from_light)) ? 1 : 0;
    }
    return count;
}

int Witness::shadow_depth_at_infinity(const glm::dvec3& direction) const {
    const mpq_class e = mpq_class(1) / (mpq_class(1) << 400);
    const Point d = point(direction);
    const Point moved{d[0] + e, d[1] + e * e, d[2] + e * e * e};
    int count = 0;
    for (std::uint32_t i = 0; i < planes_.size(); ++i) {
        if (!planes_[i].has_area || side_of_light(i) <= 0) continue;
        const std::optional<mpq_class> still = meet(planes_[i], light_, d);
        if (!still || sgn(*still) <= 0) continue;
        const std::optional<mpq_class> s = meet(planes_[i], light_, moved);
        count += s && inside(planes_[i], along(light_, *s, moved)) ? 1 : 0;
    }
    return count;
}

} // namespace shadowproof::witness
