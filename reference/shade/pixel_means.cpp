#include "reference/shade/pixel_means.h"

#include "reference/parallel.h"
#include "reference/shade/point_shader.h"
#include "reference/shade/sample_rays.h"
#include "reference/trace/visibility.h"
#include "scenes/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <vector>

namespace shadowproof {

namespace {

constexpr int fewest_rays = 4; ///< along a side of a pixel
constexpr int most_rays = 32;
constexpr int rays_of_texel = 4; ///< along its side

/// The texture coordinates that a material's maps have at the places of a triangle that rays meet.
class TriangleMaps {
public:
    TriangleMaps(const Scene& scene, std::uint32_t triangle)
        : camera_(&scene.camera), surface_(&scene.surfaces[std::size_t{3} * triangle]),
          a_(corner(scene, triangle, 0)), e_(corner(scene, triangle, 1) - a_),
          f_(corner(scene, triangle, 2) - a_) {
        across_ = glm::cross(e_, f_);
    }

    glm::dvec2 at(const glm::dvec3& line, glm::vec2 Surface::*map) const {
        const glm::dvec3 from_line = a_ - start_of(*camera_, line);
        const glm::dvec3& direction = direction_of(*camera_, line);
        const double all = glm::dot(direction, across_);
        const double b = glm::dot(direction, glm::cross(f_, from_line)) / all;
        const double c = glm::dot(direction, glm::cross(from_line, e_)) / all;
        return (1 - b - c) * glm::dvec2(surface_[0].*map) + b * glm::dvec2(surface_[1].*map) +
               c * glm::dvec2(surface_[2].*map);
    }
    double cosine(const glm::dvec3& line) const {
        const glm::dvec3& direction = direction_of(*camera_, line);
        const double lengths = glm::length(direction) * glm::length(across_);
        return lengths > 0 ? std::abs(glm::dot(direction, across_)) / lengths : 0;
    }

private:
    const Camera* camera_;
    const Surface* surface_;
    glm::dvec3 a_;
    glm::dvec3 e_; ///< edges from there
    glm::dvec3 f_;
    glm::dvec3 across_{0, 0, 0};
};

/// What a pixel's centre sees of textures.
struct Extent {
    double bump_texels = 0;       ///< along the pixel's longer side; of the bump map
    glm::dvec2 most_texels{0, 0}; ///< along its row and its column; of the bump map or the decal
    double cosine = 0;
};

Extent extent_at(const Scene& scene, std::uint32_t triangle, int x, int y) {
    const TriangleMaps maps(scene, triangle);
    const auto texels = [&](std::uint32_t texture, glm::vec2 Surface::*map) {
        if (texture == no_texture) return glm::dvec2(0);
        const Image<glm::vec4>& image = scene.textures[texture].texels;
        const auto at = [&](double column, double row) {
            return maps.at(line_of_sight(scene.camera, column, row), map) *
                   glm::dvec2(image.width, image.height);
        };
        const glm::dvec2 sides(glm::distance(at(x, y + 0.5), at(x + 1, y + 0.5)),
                               glm::distance(at(x + 0.5, y), at(x + 0.5, y + 1)));
        return std::isfinite(sides.x) && std::isfinite(sides.y) ? sides : glm::dvec2(0);
    };
    const Material& material = scene.materials[scene.meshes[mesh_of(scene, triangle)].material];
    const glm::dvec2 bumps = texels(material.bump_map, &Surface::bump_at);
    return {.bump_texels = std::max(bumps.x, bumps.y),
            .most_texels = glm::max(bumps, texels(material.decal, &Surface::decal_at)),
            .cosine = maps.cosine(line_of_sight(scene.camera, x + 0.5, y + 0.5))};
}

int rays_for(double texels) {
    int rays = fewest_rays;
    while (rays < most_rays && rays < rays_of_texel * texels) rays *= 2;
    return rays;
}

/// A light, and what one thread needs to shade by it.
struct LightShader {
    const GroundTruth& truth;
    Prober prober;
    PointShader shader;
};

/// For one thread.
class PixelShader {
public:
    PixelShader(const Tracer& tracer, const GroundTruth& truth, const TracedLights& before,
                const std::vector<ShadingTables>& tables)
        : scene_(tracer.scene()) {
        for (std::size_t i = 0; i < before.size(); ++i)
            lights_.push_back(
                {before[i]->truth, Prober(before[i]->tracer.state()), PointShader(tables[i])});
        lights_.push_back({truth, Prober(tracer.state()), PointShader(tables.back())});
    }

    struct Sums {
        glm::dvec3 color{0, 0, 0};
        glm::dvec3 alike{0, 0, 0};
        int alike_rays = 0;
        glm::dvec3 inner_columns{0, 0, 0}; ///< of every four columns the inner two less the outer
        glm::dvec3 inner_rows{0, 0, 0};
    };
    Sums shade(const SampleRays& rays) {
        Sums sums;
        for (int first = 0; first < rays.count(); first += packet_size) {
            const int count = std::min(packet_size, rays.count() - first);
            shade_packet(rays, first, count, sums);
        }
        return sums;
    }

private:
    const Scene& scene_;
    std::vector<LightShader> lights_; ///< the chosen one last

    void shade_packet(const SampleRays& rays, int first, int count, Sums& sums) {
        const std::uint32_t lanes = (1U << static_cast<unsigned>(count)) - 1;
        Vectors lines;
        for (int lane = 0; lane < count; ++lane)
            lines.set(static_cast<std::size_t>(lane), rays.at(first + lane));
        const std::uint32_t centre = lights_.back().truth.triangle.at(rays.x, rays.y);
        std::array<glm::dvec3, packet_size> colors{};
        std::array<bool, packet_size> alike{};
        alike.fill(centre != no_triangle);
        for (LightShader& light : lights_) {
            SeenLanes seen;
            LitLanes lighting;
            light.prober.see(lines, lanes, seen);
            light.prober.light(lines, lanes, seen, lighting);
            const auto for_seen = [&](const auto& work) {
                for (std::size_t lane = 0; lane < static_cast<std::size_t>(count); ++lane)
                    if (seen.triangle[lane] != no_triangle) work(lane);
            };
            for (std::size_t lane = 0; lane < static_cast<std::size_t>(count); ++lane)
                if (alike[lane])
                    alike[lane] =
                        seen.triangle[lane] != no_triangle &&
                        mesh_of(scene_, seen.triangle[lane]) == mesh_of(scene_, centre) &&
                        lighting.visibility[lane] == light.truth.visibility.at(rays.x, rays.y);
            for_seen([&](std::size_t lane) {
                light.shader.set(lane, lines[lane], seen.triangle[lane],
                                 lighting.visibility[lane] == Visibility::lit);
            });
            light.shader.shade();
            const bool is_chosen = &light == &lights_.back();
            for_seen([&](std::size_t lane) {
                colors[lane] +=
                    is_chosen ? light.shader.color(lane) : light.shader.added_color(lane);
            });
        }
        for (int lane = 0; lane < count; ++lane) {
            const auto k = static_cast<std::size_t>(lane);
            const int sample = first + lane;
            // Of four in a row the outer against the inner: of what changes evenly both have the
            // mean.
            const auto signed_by = [&](int number) {
                return number % 4 == 0 || number % 4 == 3 ? -colors[k] : colors[k];
            };
            sums.color += colors[k];
            sums.inner_columns += signed_by(sample % rays.columns);
            sums.inner_rows += signed_by(sample / rays.columns);
            if (!alike[k]) continue;
            sums.alike += colors[k];
            ++sums.alike_rays;
        }
    }
};

std::vector<ShadingTables> tables_of(const Tracer& tracer, const TracedLights& before) {
    const ShadingTables own = make_shading_tables(tracer);
    std::vector<ShadingTables> tables;
    for (const auto& light : before) tables.push_back(make_shading_tables(light->tracer, own));
    tables.push_back(own);
    return tables;
}

PixelMeans empty_means(const GroundTruth& truth) {
    const int width = truth.triangle.width;
    const int height = truth.triangle.height;
    return {.color = Image<glm::dvec3>(width, height, glm::dvec3(0)),
            .alike = Image<glm::dvec3>(width, height, glm::dvec3(0)),
            .share_alike = Image<float>(width, height),
            .texels = Image<float>(width, height),
            .cosine = Image<float>(width, height),
            .rays = Image<glm::u8vec2>(width, height)};
}

/// Of some pixels that see a surface at their centre: squared noise, in steps of 1/255.
struct Noise {
    double squares = 0;
    std::uint64_t pixels = 0;

    void add(const Noise& more) {
        squares += more.squares;
        pixels += more.pixels;
    }
    double rmse() const {
        return pixels > 0 ? std::sqrt(squares / (3.0 * static_cast<double>(pixels))) : 0;
    }
};

Noise shade_pixel(const Scene& scene, const GroundTruth& truth, int x, int y, PixelShader& shader,
                  PixelMeans& means) {
    const std::uint32_t centre = truth.triangle.at(x, y);
    const bool is_seen = centre != no_triangle;
    const Extent extent = is_seen ? extent_at(scene, centre, x, y) : Extent{};
    const glm::ivec2 sides(rays_for(extent.most_texels.x), rays_for(extent.most_texels.y));
    const PixelShader::Sums sums = shader.shade({scene.camera, sides.x, sides.y, x, y});
    const double rays = sides.x * sides.y;
    means.color.at(x, y) = sums.color / rays;
    if (sums.alike_rays > 0)
        means.alike.at(x, y) = sums.alike / static_cast<double>(sums.alike_rays);
    means.share_alike.at(x, y) = static_cast<float>(sums.alike_rays / rays);
    means.texels.at(x, y) = static_cast<float>(extent.bump_texels);
    means.cosine.at(x, y) = static_cast<float>(extent.cosine);
    means.rays.at(x, y) = glm::u8vec2(sides);
    if (!is_seen) return {};
    // Of either half, which has rays / 2, half the difference of its mean from the other's.
    const glm::dvec3 columns = 255 / rays * sums.inner_columns;
    const glm::dvec3 rows = 255 / rays * sums.inner_rows;
    return {glm::dot(columns, columns) + glm::dot(rows, rows), 1};
}

} // namespace

PixelMeans shade_pixels(const Tracer& tracer, const GroundTruth& truth,
                        const TracedLights& before) {
    const std::vector<ShadingTables> tables = tables_of(tracer, before);
    PixelMeans means = empty_means(truth);
    const int height = truth.triangle.height;
    std::vector<Noise> rows(static_cast<std::size_t>(height)); // for one sum, whoever adds
    std::vector<std::unique_ptr<PixelShader>> shaders(static_cast<std::size_t>(tracer.threads()));
    parallel_for(height, tracer.threads(), [&](int y, int thread) {
        std::unique_ptr<PixelShader>& shader = shaders[static_cast<std::size_t>(thread)];
        if (!shader) shader = std::make_unique<PixelShader>(tracer, truth, before, tables);
        for (int x = 0; x < truth.triangle.width; ++x)
            rows[static_cast<std::size_t>(y)].add(
                shade_pixel(tracer.scene(), truth, x, y, *shader, means));
    });
    Noise all;
    for (const Noise& row : rows) all.add(row);
    means.noise = all.rmse();
    return means;
}

PixelMeans shade_pixel(const Tracer& tracer, const GroundTruth& truth, int x, int y,
                       const TracedLights& before) {
    const std::vector<ShadingTables> tables = tables_of(tracer, before);
    PixelMeans means = empty_means(truth);
    PixelShader shader(tracer, truth, before, tables);
    means.noise = shade_pixel(tracer.scene(), truth, x, y, shader, means).rmse();
    return means;
}

} // namespace shadowproof
