#include "reference/witness/witness.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

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

/// A wrapped texel number: into the texture, by mirrors at its borders, or to the border.
long texel_number(Wrap wrap, long texels, mpz_class number) {
    if (wrap == Wrap::clamp_to_edge) {
        if (number < 0) return 0;
        return number >= texels ? texels - 1 : number.get_si();
    }
    const long period = wrap == Wrap::repeat ? texels : 2 * texels;
    mpz_class rest;
    mpz_fdiv_r_ui(rest.get_mpz_t(), number.get_mpz_t(), static_cast<unsigned long>(period));
    const long within = rest.get_si();
    return within < texels ? within : period - 1 - within;
}

mpz_class floor_of(const mpq_class& x) {
    mpz_class below;
    mpz_fdiv_q(below.get_mpz_t(), x.get_num_mpz_t(), x.get_den_mpz_t());
    return below;
}

/// Alpha at texture coordinates: the sum of four texels by the areas across from them.
mpq_class alpha_at(const AlphaMask& mask, const mpq_class& s, const mpq_class& t) {
    const auto texel = [&](const mpz_class& column, const mpz_class& row) {
        const long x = texel_number(mask.wrap_s, mask.alpha.width, column);
        const long y = texel_number(mask.wrap_t, mask.alpha.height, row);
        return mpq_class(double{mask.alpha.at(static_cast<int>(x), static_cast<int>(y))});
    };
    mpq_class x = s * mask.alpha.width;
    mpq_class y = t * mask.alpha.height;
    if (mask.nearest) return texel(floor_of(x), floor_of(y));
    x -= mpq_class(1, 2);
    y -= mpq_class(1, 2);
    const mpz_class left = floor_of(x);
    const mpz_class top = floor_of(y);
    const mpq_class right_share = x - left;
    const mpq_class lower_share = y - top;
    return (1 - right_share) * (1 - lower_share) * texel(left, top) +
           right_share * (1 - lower_share) * texel(left + 1, top) +
           (1 - right_share) * lower_share * texel(left, top + 1) +
           right_share * lower_share * texel(left + 1, top + 1);
}

/// Whether the triangle's mask leaves it standing at a point of its plane: with the coordinates of
/// its corners weighted by the areas across from them.
bool stands(const Plane& t, const Point& p) {
    if (t.mask == nullptr) return true;
    const mpq_class area = dot(t.normal, t.normal);
    const mpq_class of_b = dot(cross(minus(t.a, t.c), minus(p, t.c)), t.normal) / area;
    const mpq_class of_c = dot(cross(minus(t.b, t.a), minus(p, t.a)), t.normal) / area;
    const auto at = [&](std::size_t axis) {
        return mpq_class((1 - of_b - of_c) * t.mask_at[0][axis] + of_b * t.mask_at[1][axis] +
                         of_c * t.mask_at[2][axis]);
    };
    return alpha_at(*t.mask, at(0), at(1)) >= mpq_class(t.mask->least);
}

/// Where the line p + s d meets the plane; nothing where it runs along it.
std::optional<mpq_class> meet(const Plane& t, const Point& p, const Point& d) {
    if (!t.has_area) return std::nullopt;
    const mpq_class slope = dot(t.normal, d);
    if (sgn(slope) == 0) return std::nullopt;
    return mpq_class(dot(t.normal, minus(t.a, p)) / slope);
}

glm::dvec3 rounded(const Point& p) {
    return {p[0].get_d(), p[1].get_d(), p[2].get_d()};
}

/// Whether p + s d, for s from 0 to `last`, may come near the triangle. The error of doubles is
/// some 1e-15 of the coordinates; a thousand millionth of them is allowed for.
bool may_touch(const Plane& t, const glm::dvec3& p, const glm::dvec3& d, double last) {
    const glm::dvec3 to_center = t.center - p;
    const double square = glm::dot(d, d);
    const double s = square > 0 ? std::clamp(glm::dot(to_center, d) / square, 0.0, last) : 0;
    const double distance = glm::length(to_center - s * d);
    const double margin =
        1e-9 * (glm::length(p) + glm::length(t.center) + std::min(s, last) * glm::length(d));
    return !(distance > 1.000001 * t.radius + margin); // what is no number may
}

} // namespace

Witness::Witness(const Scene& scene)
    : camera_(scene.camera), eye_(point(glm::dvec3(homogeneous_eye(scene.camera)))),
      light_(point(chosen_light(scene).position)), near_(scene.camera.near) {
    const Light& light = chosen_light(scene);
    if (light.kind == Light::Kind::directional) {
        directional_ = true;
        light_ = point(-light.direction);
    }
    if (light.kind == Light::Kind::spot) {
        spot_axis_ = point(light.direction);
        spot_cosine_ = mpq_class(std::cos(light.outer_cone));
    }
    light_rounded_ = rounded(light_);
    if (std::isfinite(scene.camera.far)) far_ = mpq_class(scene.camera.far);
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
        Plane t;
        t.a = point(corner(scene, i, 0));
        t.b = point(corner(scene, i, 1));
        t.c = point(corner(scene, i, 2));
        t.normal = cross(minus(t.b, t.a), minus(t.c, t.a));
        t.has_area = sgn(dot(t.normal, t.normal)) != 0;
        t.center = (corner(scene, i, 0) + corner(scene, i, 1) + corner(scene, i, 2)) / 3.0;
        for (int k = 0; k < 3; ++k)
            t.radius = std::max(t.radius, glm::distance(t.center, corner(scene, i, k)));
        for (const Mesh& mesh : scene.meshes) {
            if (i < mesh.first_triangle || i >= mesh.first_triangle + mesh.triangle_count) continue;
            t.seen_from_behind = scene.materials[mesh.material].double_sided;
            t.casts = mesh.casts;
            t.receives = mesh.receives;
            const std::uint32_t mask = scene.materials[mesh.material].mask;
            if (mask == no_mask) continue;
            t.mask = &scene.masks[mask];
            for (int k = 0; k < 3; ++k) {
                const glm::dvec2 at = scene.mask_at[scene.triangles[i][k]];
                t.mask_at[static_cast<std::size_t>(k)] = {mpq_class(at.x), mpq_class(at.y)};
            }
        }
        planes_.push_back(t);
    }
}

Point Witness::on_ray(const glm::dvec3& line, double depth) const {
    return along(point(start_of(camera_, line)), mpq_class(depth),
                 point(direction_of(camera_, line)));
}

int Witness::side_of_eye(std::uint32_t triangle) const {
    return sgn(dot(planes_[triangle].normal,
                   camera_.is_orthographic() ? eye_ : minus(eye_, planes_[triangle].a)));
}

int Witness::side_of_light(std::uint32_t triangle) const {
    return sgn(
        dot(planes_[triangle].normal, directional_ ? light_ : minus(light_, planes_[triangle].a)));
}

Point Witness::to_light(const Point& p) const {
    return directional_ ? light_ : minus(light_, p);
}

/// Of p + s (to_light(p)): strictly between p and the light.
bool Witness::lies_between(const mpq_class& s) const {
    return sgn(s) > 0 && (directional_ || s < 1);
}

int Witness::side_of_cone(const Point& p) const {
    if (!spot_axis_) return 1;
    const Point v = minus(p, light_);
    // The larger of two numbers is the one of the larger signed square.
    const auto signed_square = [](const mpq_class& x) { return mpq_class(x * abs(x)); };
    const mpq_class limit = spot_cosine_ * abs(spot_cosine_) * dot(v, v);
    return sgn(mpq_class(signed_square(dot(v, *spot_axis_)) - limit));
}

bool Witness::occluded(const Point& hit, std::uint32_t own) const {
    const Point d = to_light(hit);
    const glm::dvec3 from = rounded(hit);
    const glm::dvec3 toward = directional_ ? light_rounded_ : light_rounded_ - from;
    const double last = directional_ ? std::numeric_limits<double>::infinity() : 1;
    for (std::uint32_t i = 0; i < planes_.size(); ++i) {
        if (i == own || !planes_[i].casts || !may_touch(planes_[i], from, toward, last)) continue;
        const std::optional<mpq_class> s = meet(planes_[i], hit, d);
        if (s && lies_between(*s) && inside(planes_[i], along(hit, *s, d)) &&
            stands(planes_[i], along(hit, *s, d)))
            return true;
    }
    return false;
}

Answer Witness::look(const glm::dvec3& line) const {
    const glm::dvec3& start = start_of(camera_, line);
    const glm::dvec3& direction = direction_of(camera_, line);
    const Point from = point(start);
    const Point d = point(direction);
    Answer answer;
    std::optional<mpq_class> nearest;
    for (std::uint32_t i = 0; i < planes_.size(); ++i) {
        if (!may_touch(planes_[i], start, direction, std::numeric_limits<double>::infinity()))
            continue;
        const std::optional<mpq_class> t = meet(planes_[i], from, d);
        if (!t || *t < near_ || (far_ && *t > *far_) || (nearest && *t >= *nearest)) continue;
        if (!planes_[i].seen_from_behind && side_of_eye(i) <= 0) continue;
        const Point met = along(from, *t, d);
        if (!inside(planes_[i], met) || !stands(planes_[i], met)) continue;
        nearest = t;
        answer.triangle = i;
    }
    if (!nearest) return answer;
    answer.hit = along(from, *nearest, d);
    const bool faces = side_of_eye(answer.triangle) * side_of_light(answer.triangle) > 0;
    const bool reached =
        faces && side_of_cone(answer.hit) >= 0 &&
        (!planes_[answer.triangle].receives || !occluded(answer.hit, answer.triangle));
    answer.visibility = reached ? Visibility::lit : Visibility::shadowed;
    return answer;
}

int Witness::shadow_depth(const Point& q, std::uint32_t skip) const {
    const mpq_class e = mpq_class(1) / (mpq_class(1) << 400);
    const Point moved{q[0] + e, q[1] + e * e, q[2] + e * e * e};
    int count = 0;
    for (std::uint32_t i = 0; i < planes_.size(); ++i) {
        if (i == skip || !planes_[i].casts || !planes_[i].has_area || side_of_light(i) <= 0)
            continue;
        const std::optional<mpq_class> still = meet(planes_[i], q, to_light(q));
        if (!still || !lies_between(*still)) continue;
        const std::optional<mpq_class> s = meet(planes_[i], moved, to_light(moved));
        count += s && inside(planes_[i], along(moved, *s, to_light(moved))) ? 1 : 0;
    }
    return count;
}

namespace {

Point moved_by_next_to_nothing(const Point& d) {
    const mpq_class e = mpq_class(1) / (mpq_class(1) << 400);
    return {d[0] + e, d[1] + e * e, d[2] + e * e * e};
}

} // namespace

int Witness::shadow_depth_at_infinity(const glm::dvec3& line) const {
    const Point d = point(direction_of(camera_, line));
    const Point moved = moved_by_next_to_nothing(d);
    if (directional_)
        return shadow_depth(along(point(start_of(camera_, line)), mpq_class(1) << 2000,
                                  camera_.is_orthographic() ? moved : d),
                            no_triangle);
    int count = 0;
    for (std::uint32_t i = 0; i < planes_.size(); ++i) {
        if (!planes_[i].casts || !planes_[i].has_area || side_of_light(i) <= 0) continue;
        const std::optional<mpq_class> still = meet(planes_[i], light_, d);
        if (!still || sgn(*still) <= 0) continue;
        const std::optional<mpq_class> s = meet(planes_[i], light_, moved);
        count += s && inside(planes_[i], along(light_, *s, moved)) ? 1 : 0;
    }
    return count;
}

int Witness::shadow_depth_at_eye() const {
    const glm::dvec3& line = eye_line(camera_);
    if (!camera_.is_orthographic()) return shadow_depth(on_ray(line, 0), no_triangle);
    const Point forward = moved_by_next_to_nothing(point(camera_.forward));
    if (directional_)
        return shadow_depth(along(point(line), -(mpq_class(1) << 2000), forward), no_triangle);
    int count = 0;
    for (std::uint32_t i = 0; i < planes_.size(); ++i) {
        if (!planes_[i].casts || !planes_[i].has_area || side_of_light(i) <= 0) continue;
        const std::optional<mpq_class> s = meet(planes_[i], light_, forward);
        count += s && sgn(*s) < 0 && inside(planes_[i], along(light_, *s, forward)) ? 1 : 0;
    }
    return count;
}

} // namespace shadowproof::witness
