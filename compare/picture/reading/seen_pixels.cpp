#include "compare/picture/reading/seen_pixels.h"

#include "compare/picture/predict.h"
#include "compare/picture/reading/shading_normals.h"
#include "compare/picture/surface_colors.h"
#include "reference/shade/shading.h"
#include "scenes/camera.h"
#include "scenes/spot_cone.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <vector>

namespace shadowproof {

namespace {

/// Pixels from an outline of the truth that soft shadows, and outlines that are a little elsewhere,
/// do not reach.
constexpr int certain_from = 3;

ShadingNormals normals_of(const TracedScene& traced) {
    std::vector<std::uint32_t> seen = traced.truth().triangle.pixels;
    std::ranges::sort(seen);
    const auto repeated = std::ranges::unique(seen);
    seen.erase(repeated.begin(), repeated.end());
    if (!seen.empty() && seen.back() == no_triangle) seen.pop_back();
    return {traced.scene(), std::move(seen)};
}

Lie lie_of(const glm::dvec3& normal, const glm::dvec3& to_light, const glm::dvec3& half) {
    const double length = glm::length(normal);
    return {
        static_cast<float>(glm::dot(normal, to_light) / length),
        static_cast<float>(glm::length(glm::cross(normal, half)) / (length * glm::length(half)))};
}

/// `bumped`: the normal by bumps; none: there are no bump maps.
Lies lies_at(const Scene& scene, const ShadingNormals& normals, std::uint32_t triangle,
             const glm::dvec3& point, const glm::dvec3* bumped) {
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    const glm::dvec3 to_light = glm::normalize(glm::dvec3(light) - light.w * point);
    const glm::dvec3 half = to_light + way_to_eye(scene.camera, point);
    const double side =
        glm::dot(normals.at(NormalsBy::faces, triangle, point), to_light) < 0 ? -1 : 1;
    Lies lies{};
    for (std::size_t i = 0; i < lies.size(); ++i) {
        const NormalsBy by = all_normals_by[i];
        const glm::dvec3 normal = by == NormalsBy::bumps && bumped != nullptr
                                      ? *bumped
                                      : side * normals.at(by, triangle, point);
        lies[i] = lie_of(normal, to_light, half);
    }
    return lies;
}

/// The bumped normals of a row of pixels, towards the seen side.
class BumpedRow {
public:
    explicit BumpedRow(const TracedScene& traced) : traced_(traced) {
        if (is_bump_lit(traced.scene())) shader_ = std::make_unique<RayShader>(traced.tracer());
    }

    void set(int y) {
        if (!shader_) return;
        const Image<std::uint32_t>& triangles = traced_.truth().triangle;
        columns_.clear();
        points_.clear();
        for (int x = 0; x < triangles.width; ++x) {
            columns_.push_back(points_.size());
            if (triangles.at(x, y) != no_triangle)
                points_.push_back(
                    {line_of_sight(traced_.scene().camera, x + 0.5, y + 0.5), triangles.at(x, y)});
        }
        shadings_.resize(points_.size());
        shader_->shade(points_, shadings_);
    }
    /// None without bump maps.
    const glm::dvec3* at(int x) const {
        return shader_ ? &shadings_[columns_[static_cast<std::size_t>(x)]].bumped : nullptr;
    }

private:
    const TracedScene& traced_;
    std::unique_ptr<RayShader> shader_;
    std::vector<SeenPoint> points_;
    std::vector<std::size_t> columns_; ///< of each column the place of its point
    std::vector<Shading> shadings_;
};

/// Of a point that is in the cone.
float into_cone(const Light& light, const glm::dvec3& point) {
    // The truth says, exactly, that it is in: 0 would say that it is not.
    constexpr double least = std::numeric_limits<float>::min();
    const SpotCone cone = spot_cone(light);
    const double cosine = glm::dot(glm::normalize(point - light.position), light.direction);
    return static_cast<float>(std::clamp((cosine - cone.cos_outer) * cone.scale, least, 1.0));
}

/// Whether a pixel beside it sees another mesh or a surface that lies otherwise, whose colour an
/// antialiased picture mixes in.
bool is_at_crease(const SeenPixels& pixels, int x, int y) {
    constexpr float otherwise = 2.0F / angle_groups;
    const Seen& own = *pixels.at(x, y);
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, pixels.height - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, pixels.width - 1); ++u) {
            const std::optional<Seen>& other = pixels.at(u, v);
            if (!other || other->mesh != own.mesh ||
                !(std::abs(other->observed.lies[0].sine - own.observed.lies[0].sine) < otherwise))
                return true;
        }
    return false;
}

/// Says of each pixel what it certainly is: where all pixels as near as certain_from have its
/// class, but those of its mesh that face away from the light; and where it is at no crease.
void find_certain(const Image<Visibility>& truth, SeenPixels& pixels) {
    const auto is_certain = [&](int x, int y) {
        const Seen& own = *pixels.at(x, y);
        for (int v = std::max(y - certain_from, 0);
             v <= std::min(y + certain_from, truth.height - 1); ++v)
            for (int u = std::max(x - certain_from, 0);
                 u <= std::min(x + certain_from, truth.width - 1); ++u) {
                const std::optional<Seen>& other = pixels.at(u, v);
                const bool is_averted =
                    other && other->mesh == own.mesh && !other->observed.faces_light;
                if (truth.at(u, v) != truth.at(x, y) && !is_averted) return false;
            }
        return !is_at_crease(pixels, x, y);
    };
    for (int y = 0; y < truth.height; ++y)
        for (int x = 0; x < truth.width; ++x)
            if (pixels.at(x, y) && pixels.at(x, y)->observed.faces_light && is_certain(x, y))
                pixels.at(x, y)->observed.certainly = truth.at(x, y);
}

} // namespace

SeenPixels seen_pixels(const TracedScene& traced) {
    const Scene& scene = traced.scene();
    const Image<Visibility>& truth = traced.truth().visibility;
    const ShadingNormals normals = normals_of(traced);
    const Light& light = chosen_light(scene);
    SeenPixels pixels(truth.width, truth.height);
    BumpedRow bumped(traced);
    for (int y = 0; y < truth.height; ++y) {
        bumped.set(y);
        for (int x = 0; x < truth.width; ++x) {
            const std::uint32_t triangle = traced.truth().triangle.at(x, y);
            if (triangle == no_triangle) continue;
            Seen& seen = pixels.at(x, y).emplace();
            seen.mesh = mesh_of(scene, triangle);
            const glm::dvec3 point = seen_point(traced, x, y);
            seen.observed.lies = lies_at(scene, normals, triangle, point, bumped.at(x));
            if (light.kind != Light::Kind::directional)
                seen.observed.distance = static_cast<float>(glm::distance(point, light.position));
            if (light.kind == Light::Kind::spot)
                seen.observed.into_cone =
                    in_cone(traced.truth(), truth.index(x, y)) ? into_cone(light, point) : 0;
            seen.observed.faces_light = sides_of(traced.tracer(), triangle).faces_light();
        }
    }
    find_certain(truth, pixels);
    return pixels;
}

} // namespace shadowproof
