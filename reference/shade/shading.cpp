#include "reference/shade/shading.h"

#include "reference/shade/point_shader.h"
#include "reference/shade/sample_rays.h"
#include "reference/trace/tiles.h"

#include <cassert>
#include <memory>
#include <utility>

namespace shadowproof {

namespace {

/// One shader per thread, made where the thread first needs one.
class Shaders {
public:
    Shaders(const ShadingTables& tables, int threads)
        : tables_(tables), shaders_(static_cast<std::size_t>(threads)) {}
    PointShader& of(int thread) {
        std::unique_ptr<PointShader>& shader = shaders_[static_cast<std::size_t>(thread)];
        if (!shader) shader = std::make_unique<PointShader>(tables_);
        return *shader;
    }

private:
    const ShadingTables& tables_;
    std::vector<std::unique_ptr<PointShader>> shaders_;
};

/// Calls `use` for every pixel that sees a surface, with its index, a shader and the pixel's lane.
template <class Use>
void shade_seen(const Tracer& tracer, const GroundTruth& truth, const Use& use) {
    const Camera& camera = tracer.scene().camera;
    assert(truth.triangle.width == camera.width && truth.triangle.height == camera.height);
    const ShadingTables tables = make_shading_tables(tracer);
    Shaders shaders(tables, tracer.threads());
    const PixelRays rays(camera);
    const auto shade_tile = [&](const Tile& tile, PointShader& shader) {
        const auto pixel = [&](std::size_t lane) {
            return truth.triangle.index(tile.x(lane), tile.y(lane));
        };
        std::uint32_t seen = 0;
        for (std::size_t lane = 0; lane < packet_size; ++lane) {
            if ((tile.lanes >> lane & 1U) == 0) continue;
            const std::uint32_t triangle = truth.triangle.pixels[pixel(lane)];
            if (triangle == no_triangle) continue;
            shader.set(lane, tile.lines[lane], triangle,
                       truth.visibility.pixels[pixel(lane)] == Visibility::lit);
            seen |= 1U << lane;
        }
        if (seen == 0) return;
        shader.shade();
        for (std::size_t lane = 0; lane < packet_size; ++lane)
            if ((seen >> lane & 1U) != 0) use(pixel(lane), shader, lane);
    };
    const int rows = (camera.height + tile_side - 1) / tile_side;
    parallel_for(rows, tracer.threads(), [&](int row, int thread) {
        Tile tile;
        for (int left = 0; left < camera.width; left += tile_side) {
            rays.set(tile, left, row * tile_side);
            shade_tile(tile, shaders.of(thread));
        }
    });
}

/// What lights add, together; empty where there are none.
Image<glm::dvec3> added_by(const TracedLights& lights) {
    Image<glm::dvec3> sum;
    for (const auto& light : lights) {
        const Image<std::uint32_t>& size = light->truth.triangle;
        if (sum.pixels.empty()) sum = Image<glm::dvec3>(size.width, size.height, glm::dvec3(0));
        shade_seen(light->tracer, light->truth,
                   [&](std::size_t pixel, const PointShader& shader, std::size_t lane) {
                       sum.pixels[pixel] += shader.added_color(lane);
                   });
    }
    return sum;
}

/// Adds a picture to another; an empty one is nothing.
void add(const Image<glm::dvec3>& more, Image<glm::dvec3>& sum) {
    for (std::size_t i = 0; i < more.pixels.size(); ++i) sum.pixels[i] += more.pixels[i];
}

struct Sum {
    glm::dvec3 color{0, 0, 0};
    int seen = 0;
};

/// `of`: the colour of what a ray sees, from a shader and the ray's lane.
template <class Of>
Sum sum_of(const SampleRays& rays, Prober& prober, PointShader& shader, const Of& of) {
    Sum sum;
    for (int first = 0; first < rays.count(); first += packet_size) {
        const int count = std::min(packet_size, rays.count() - first);
        Vectors lines;
        for (int lane = 0; lane < count; ++lane)
            lines.set(static_cast<std::size_t>(lane), rays.at(first + lane));
        const std::uint32_t lanes = (1U << static_cast<unsigned>(count)) - 1;
        SeenLanes seen;
        LitLanes lighting;
        prober.see(lines, lanes, seen);
        prober.light(lines, lanes, seen, lighting);
        const auto for_seen = [&](const auto& work) {
            for (std::size_t lane = 0; lane < static_cast<std::size_t>(count); ++lane)
                if (seen.triangle[lane] != no_triangle) work(lane);
        };
        for_seen([&](std::size_t lane) {
            shader.set(lane, lines[lane], seen.triangle[lane],
                       lighting.visibility[lane] == Visibility::lit);
            ++sum.seen;
        });
        shader.shade();
        for_seen([&](std::size_t lane) { sum.color += of(shader, lane); });
    }
    return sum;
}

/// The mean of `of` over n x n rays of each pixel, added to `color`. `seen`: takes the share of the
/// rays that see a surface.
template <class Of, class Seen>
void add_means(const Tracer& tracer, int n, Image<glm::dvec3>& color, const Of& of,
               const Seen& seen) {
    const Tracer::State& state = tracer.state();
    const Camera& camera = state.scene->camera;
    assert(n >= 1 && n <= 32);
    const ShadingTables tables = make_shading_tables(tracer);
    Shaders shaders(tables, state.threads);
    std::vector<std::unique_ptr<Prober>> probers(static_cast<std::size_t>(state.threads));
    parallel_for(camera.height, state.threads, [&](int y, int thread) {
        std::unique_ptr<Prober>& prober = probers[static_cast<std::size_t>(thread)];
        if (!prober) prober = std::make_unique<Prober>(state);
        for (int x = 0; x < camera.width; ++x) {
            const Sum sum = sum_of({camera, n, n, x, y}, *prober, shaders.of(thread), of);
            const double samples = n * n;
            color.at(x, y) += sum.color / samples;
            seen(x, y, sum.seen / samples);
        }
    });
}

} // namespace

Image<glm::dvec3> shade(const Tracer& tracer, const GroundTruth& truth,
                        const TracedLights& before) {
    Image<glm::dvec3> colors(truth.triangle.width, truth.triangle.height, glm::dvec3(0));
    shade_seen(tracer, truth, [&](std::size_t pixel, const PointShader& shader, std::size_t lane) {
        colors.pixels[pixel] = shader.color(lane);
    });
    add(added_by(before), colors);
    return colors;
}

Image<Shading> shade_terms(const Tracer& tracer, const GroundTruth& truth,
                           const TracedLights& before) {
    Image<Shading> terms(truth.triangle.width, truth.triangle.height, Shading{});
    shade_seen(tracer, truth, [&](std::size_t pixel, const PointShader& shader, std::size_t lane) {
        terms.pixels[pixel] = shader.terms(lane);
    });
    const Image<glm::dvec3> more = added_by(before);
    for (std::size_t i = 0; i < more.pixels.size(); ++i)
        terms.pixels[i].before_color = more.pixels[i];
    return terms;
}

std::optional<Shading> shade_ray(const Tracer& tracer, const glm::dvec3& line) {
    const RayTruth truth = trace_ray(tracer, line);
    if (truth.triangle == no_triangle) return std::nullopt;
    const ShadingTables tables = make_shading_tables(tracer);
    PointShader shader(tables);
    shader.set(0, line, truth.triangle, truth.visibility == Visibility::lit);
    shader.shade();
    return shader.terms(0);
}

struct RayShader::State {
    ShadingTables tables;
    PointShader shader;

    explicit State(const Tracer& tracer) : tables(make_shading_tables(tracer)), shader(tables) {}
};

RayShader::RayShader(const Tracer& tracer) : state_(std::make_unique<State>(tracer)) {}
RayShader::~RayShader() = default;

void RayShader::shade(std::span<const SeenPoint> points, std::span<Shading> shadings) {
    assert(points.size() == shadings.size());
    PointShader& shader = state_->shader;
    for (std::size_t first = 0; first < points.size(); first += packet_size) {
        const std::size_t count = std::min<std::size_t>(packet_size, points.size() - first);
        for (std::size_t lane = 0; lane < count; ++lane) {
            const SeenPoint& point = points[first + lane];
            shader.set(lane, point.line, point.triangle, point.lit);
        }
        shader.shade();
        for (std::size_t lane = 0; lane < count; ++lane)
            shadings[first + lane] = shader.terms(lane);
    }
}

Supersampled shade_supersampled(const Tracer& tracer, int n, const TracedLights& before) {
    const Camera& camera = tracer.scene().camera;
    const Image<glm::dvec3> black(camera.width, camera.height, glm::dvec3(0));
    Supersampled result{black, Image<double>(camera.width, camera.height, 0)};
    add_means(
        tracer, n, result.color,
        [](const PointShader& shader, std::size_t lane) { return shader.color(lane); },
        [&](int x, int y, double share) { result.coverage.at(x, y) = share; });
    if (before.empty()) return result;
    Image<glm::dvec3> more = black;
    for (const auto& light : before)
        add_means(
            light->tracer, n, more,
            [](const PointShader& shader, std::size_t lane) { return shader.added_color(lane); },
            [](int, int, double) {});
    add(more, result.color);
    return result;
}

} // namespace shadowproof
