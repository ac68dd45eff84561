#include "raster/traced/shadow_rays.h"

#include "raster/traced/embree_world.h"
#include "scenes/camera.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof {

namespace {

/// Whether Embree takes it: its builds with assertions stop the process at larger numbers.
bool may_be_shot(const FloatRay& ray) {
    const auto fits = [](const glm::vec3& v) {
        return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) < embree_largest &&
               !std::isnan(v.x + v.y + v.z);
    };
    return fits(ray.origin) && fits(ray.direction) && ray.direction != glm::vec3(0, 0, 0) &&
           ray.far > ray.near;
}

/// The unit normal of a triangle on the light's side; `sign`: positive where that is its front.
glm::vec3 normal_of(const Scene& scene, std::uint32_t triangle, double sign) {
    const glm::dvec3 a = corner(scene, triangle, 0);
    const glm::dvec3 normal =
        glm::cross(corner(scene, triangle, 1) - a, corner(scene, triangle, 2) - a);
    return normal * ((sign < 0 ? -1 : 1) / glm::length(normal));
}

/// A picture in the making.
class RayPicture {
public:
    RayPicture(const Scene& scene, const RayRecipe& recipe)
        : scene_(scene), recipe_(recipe), world_(scene), receives_(receiving_triangles(scene)),
          light_(chosen_light(scene)) {
        frame_.family = "traced";
        frame_.claim = Image<Visibility>(scene.camera.width, scene.camera.height);
        TracedRays& rays = frame_.rays.emplace();
        rays.model = recipe.model;
        rays.is_parallel = scene.camera.is_orthographic();
        rays.eye = scene.camera.eye;
        rays.forward = scene.camera.forward;
        rays.near = static_cast<float>(scene.camera.near);
        rays.far = static_cast<float>(scene.camera.far);
        rays.pixels = Image<TracedPixel>(scene.camera.width, scene.camera.height);
        for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
            to_light_.push_back(side(scene, i, homogeneous(light_)));
            to_eye_.push_back(side(scene, i, homogeneous_eye(scene.camera)));
        }
    }

    /// A square of four by four pixels.
    void trace_tile(int left, int top) {
        const auto at = [&](std::size_t lane) {
            const int i = static_cast<int>(lane);
            return std::pair(left + i % side_length, top + i / side_length);
        };
        FloatRays eye;
        FloatRays shadow;
        for (std::size_t i = 0; i < traced_packet; ++i) {
            const auto [x, y] = at(i);
            eye.valid[i] = x < scene_.camera.width && y < scene_.camera.height;
            if (!eye.valid[i]) continue;
            const glm::vec3 line = line_of_sight(scene_.camera, x + 0.5, y + 0.5);
            const FloatRay ray = frame_.rays->eye_ray(line);
            eye.valid[i] = may_be_shot(ray);
            set(eye, i, ray);
            frame_.rays->pixels.at(x, y).line = line;
        }
        world_.find_nearest(eye);
        for (std::size_t i = 0; i < traced_packet; ++i) {
            if (!eye.valid[i]) continue;
            const auto [x, y] = at(i);
            look_at(eye, i, frame_.rays->pixels.at(x, y), frame_.claim.at(x, y), shadow);
        }
        world_.find_any(shadow);
        for (std::size_t i = 0; i < traced_packet; ++i) {
            if (!shadow.valid[i]) continue;
            const auto [x, y] = at(i);
            frame_.rays->pixels.at(x, y).occluder = shadow.hit[i];
            if (shadow.hit[i] != no_triangle) frame_.claim.at(x, y) = Visibility::shadowed;
        }
    }

    void trace_all() {
        for (int top = 0; top < scene_.camera.height; top += side_length)
            for (int left = 0; left < scene_.camera.width; left += side_length)
                trace_tile(left, top);
    }

    Frame& frame() { return frame_; }

private:
    static constexpr int side_length = 4;

    const Scene& scene_;
    const RayRecipe& recipe_;
    EmbreeWorld world_;
    std::vector<std::uint8_t> receives_;
    const Light& light_;
    std::vector<double> to_light_; ///< scenes/scene.h, side(); one per triangle
    std::vector<double> to_eye_;
    Frame frame_;

    static void set(FloatRays& rays, std::size_t lane, const FloatRay& ray) {
        rays.origin_x[lane] = ray.origin.x;
        rays.origin_y[lane] = ray.origin.y;
        rays.origin_z[lane] = ray.origin.z;
        rays.direction_x[lane] = ray.direction.x;
        rays.direction_y[lane] = ray.direction.y;
        rays.direction_z[lane] = ray.direction.z;
        rays.near[lane] = ray.near;
        rays.far[lane] = ray.far;
    }

    bool faces_light(std::uint32_t triangle) const {
        return to_light_[triangle] * to_eye_[triangle] > 0 || !recipe_.tells_sides_apart;
    }
    bool in_cone(const glm::vec3& point) const {
        if (light_.kind != Light::Kind::spot) return true;
        const glm::dvec3 from_light = glm::dvec3(point) - light_.position;
        return glm::dot(from_light, light_.direction) >=
               std::cos(light_.outer_cone) * glm::length(from_light);
    }

    /// What the eye ray met; sets the shadow ray where one is needed, and the claim without it.
    void look_at(const FloatRays& eye, std::size_t lane, TracedPixel& pixel, Visibility& claim,
                 FloatRays& shadow) const {
        const std::uint32_t triangle = eye.hit[lane];
        if (triangle == no_triangle) return;
        pixel.seen = triangle;
        pixel.depth = eye.far[lane];
        claim = Visibility::shadowed;
        const FloatRay ray = frame_.rays->eye_ray(pixel.line);
        const glm::vec3 point = ray.origin + pixel.depth * ray.direction;
        if (!faces_light(triangle) || !in_cone(point)) return;
        claim = Visibility::lit;
        if (receives_[triangle] == 0) return;
        pixel.shadow = recipe_.shadow_ray(
            recipe_.model, {point, normal_of(scene_, triangle, to_light_[triangle])}, light_);
        pixel.shot = may_be_shot(pixel.shadow);
        if (!pixel.shot) return;
        set(shadow, lane, pixel.shadow);
        shadow.own[lane] = recipe_.skips_own ? triangle : no_triangle;
        shadow.valid[lane] = true;
    }
};

float in_scene_units(const Scene& scene, double length) {
    return static_cast<float>(length / scene.unit);
}

} // namespace

FloatRay shadow_ray(const RayModel& model, const RoundedHit& hit, const Light& light) {
    FloatRay ray;
    const bool is_off = model.start == RayModel::Start::offset;
    ray.origin = is_off ? hit.point + model.distance * hit.normal : hit.point;
    ray.near = model.start == RayModel::Start::epsilon ? model.distance : 0;
    if (light.kind == Light::Kind::directional) {
        ray.direction = -light.direction;
        return ray;
    }
    const glm::vec3 to_light = glm::vec3(light.position) - ray.origin;
    const float squared =
        to_light.x * to_light.x + to_light.y * to_light.y + to_light.z * to_light.z;
    const float length = std::sqrt(squared);
    if (!(length > 0) || std::isinf(length)) return ray;
    ray.direction = to_light / length;
    ray.far = length;
    return ray;
}

RayRecipe epsilon_recipe(const Scene& scene, const Plan& plan) {
    const double epsilon = plan.asked.rays.epsilon.value_or(customary_epsilon);
    return {.model = {RayModel::Start::epsilon, in_scene_units(scene, epsilon)},
            .shadow_ray = shadow_ray};
}

RayRecipe offset_recipe(const Scene& scene, const Plan& plan) {
    const double offset = plan.asked.rays.offset.value_or(customary_epsilon);
    return {.model = {RayModel::Start::offset, in_scene_units(scene, offset)},
            .shadow_ray = shadow_ray};
}

RayRecipe skip_recipe() {
    return {.model = {RayModel::Start::skip, 0}, .shadow_ray = shadow_ray, .skips_own = true};
}

Frame trace_shadow_rays(const Scene& scene, const RayRecipe& recipe) {
    const auto start = std::chrono::steady_clock::now();
    const auto passed = [&] {
        const auto elapsed = std::chrono::steady_clock::now() - start;
        return std::chrono::duration<double, std::milli>(elapsed).count();
    };
    RayPicture picture(scene, recipe);
    const double building = passed();
    picture.trace_all();
    Frame& frame = picture.frame();
    frame.milliseconds = passed();
    frame.stages = {{"hierarchy", building}, {"rays", frame.milliseconds - building}};
    return std::move(frame);
}

} // namespace shadowproof
