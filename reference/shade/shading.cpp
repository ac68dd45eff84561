#include "reference/shade/shading.h"

#include "reference/shade/point_shader.h"
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

/// The result of `of` for every pixel that sees a surface, from a shader and the pixel's lane.
template <class T, class Of>
Image<T> shaded(const Tracer& tracer, const GroundTruth& truth, const Of& of) {
    const Camera& camera = tracer.scene().camera;
    assert(truth.triangle.width == camera.width && truth.triangle.height == camera.height);
    const ShadingTables tables = make_shading_tables(tracer);
    Shaders shaders(tables, tracer.threads());
    const PixelRays rays(camera);
    Image<T> picture(camera.width, camera.height, T{});
    const auto shade_tile = [&](const Tile& tile, PointShader& shader) {
        std::uint32_t seen = 0;
        for (std::size_t lane = 0; lane < packet_size; ++lane) {
            if ((tile.lanes >> lane & 1U) == 0) continue;
            const std::size_t pixel = picture.index(tile.x(lane), tile.y(lane));
            const std::uint32_t triangle = truth.triangle.pixels[pixel];
            if (triangle == no_triangle) continue;
            shader.set(lane, tile.directions[lane], triangle,
                       truth.visibility.pixels[pixel] == Visibility::lit);
            seen |= 1U << lane;
        }
        if (seen == 0) return;
        shader.shade();
        for (std::size_t lane = 0; lane < packet_size; ++lane)
            if ((seen >> lane & 1U) != 0) picture.at(tile.x(lane), tile.y(lane)) = of(shader, lane);
    };
    const int rows = (camera.height + tile_side - 1) / tile_side;
    parallel_for(rows, tracer.threads(), [&](int row, int thread) {
        Tile tile;
        for (int left = 0; left < camera.width; left += tile_side) {
            rays.set(tile, left, row * tile_side);
            shade_tile(tile, shaders.of(thread));
        }
    });
    return picture;
}

/// n x n rays of one pixel, sixteen at a time.
struct SampleRays {
    const Camera& camera;
    int n = 1;
    int x = 0;
    int y = 0;

    glm::dvec3 at(int sample) const {
        const double size = n;
        return ray_column(camera, x + (sample % n + 0.5) / size) +
               ray_row(camera, y + (sample / n + 0.5) / size);
    }
};

struct Sum {
    glm::dvec3 color{0, 0, 0};
    int seen = 0;
};

/// `of`: the colour of what a ray sees, from a shader and the ray's lane.
template <class Of>
Sum sum_of(const SampleRays& rays, Prober& prober, PointShader& shader, const Of& of) {
    Sum sum;
    const int samples = rays.n * rays.n;
    for (int first = 0; first < samples; first += packet_size) {
        const int count = std::min(packet_size, samples - first);
        Vectors directions;
        for (int lane = 0; lane < count; ++lane)
            directions.set(static_cast<std::size_t>(lane), rays.at(first + lane));
        const std::uint32_t lanes = (1U << static_cast<unsigned>(count)) - 1;
        SeenLanes seen;
        LitLanes lighting;
        prober.see(directions, lanes, seen);
        prober.light(directions, lanes, seen, lighting);
        const auto for_seen = [&](const auto& work) {
            for (std::size_t lane = 0; lane < static_cast<std::size_t>(count); ++lane)
                if (seen.triangle[lane] != no_triangle) work(lane);
        };
        for_seen([&](std::size_t lane) {
            shader.set(lane, directions[lane], seen.triangle[lane],
                       lighting.visibility[lane] == Visibility::lit);
            ++sum.seen;
        });
        shader.shade();
        for_seen([&](std::size_t lane) { sum.color += of(shader, lane); });
    }
    return sum;
}

} // namespace

namespace {

/// Adds a picture to another; an empty one is nothing.
void add(const Image<glm::dvec3>& more, Image<glm::dvec3>& sum) {
    for (std::size_t i = 0; i < more.pixels.size(); ++i) sum.pixels[i] += more.pixels[i];
}

/// The sum of what `of` gives of each light; empty where there are none.
template <class Of>
Image<glm::dvec3> sum_over(const TracedLights& lights, const Of& of) {
    Image<glm::dvec3> sum;
    for (const auto& light : lights) {
        Image<glm::dvec3> more = of(*light);
        if (sum.pixels.empty())
            sum = std::move(more);
        else
            add(more, sum);
    }
    return sum;
}

/// What lights add, together; empty where there are none.
Image<glm::dvec3> added_by(const TracedLights& lights) {
    return sum_over(lights, [](const TracedLight& light) {
        return shaded<glm::dvec3>(
            light.tracer, light.truth,
            [](const PointShader& shader, std::size_t lane) { return shader.added_color(lane); });
    });
}

} // namespace

Image<glm::dvec3> shade(const Tracer& tracer, const GroundTruth& truth,
                        const TracedLights& before) {
    Image<glm::dvec3> colors =
        shaded<glm::dvec3>(tracer, truth, [](const PointShader& shader, std::size_t lane) {
            return shader.color(lane);
        });
    add(added_by(before), colors);
    return colors;
}

Image<Shading> shade_terms(const Tracer& tracer, const GroundTruth& truth,
                           const TracedLights& before) {
    Image<Shading> terms =
        shaded<Shading>(tracer, truth, [](const PointShader& shader, std::size_t lane) {
            return shader.terms(lane);
        });
    const Image<glm::dvec3> more = added_by(before);
    for (std::size_t i = 0; i < more.pixels.size(); ++i)
        terms.pixels[i].before_color = more.pixels[i];
    return terms;
}

std::optional<Shading> shade_ray(const Tracer& tracer, const glm::dvec3& direction) {
    const RayTruth truth = trace_ray(tracer, direction);
    if (truth.triangle == no_triangle) return std::nullopt;
    const ShadingTables tables = make_shading_tables(tracer);
    PointShader shader(tables);
    shader.set(0, direction, truth.triangle, truth.visibility == Visibility::lit);
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
            shader.set(lane, point.direction, point.triangle, point.lit);
        }
        shader.shade();
        for (std::size_t lane = 0; lane < count; ++lane)
            shadings[first + lane] = shader.terms(lane);
    }
}

namespace {

/// The mean of `of` over n x n rays of each pixel.
template <class Of>
Supersampled supersampled(const Tracer& tracer, int n, const Of& of) {
    const Tracer::State& state = tracer.state();
    const Camera& camera = state.scene->camera;
    assert(n >= 1 && n <= 32);
    const ShadingTables tables = make_shading_tables(tracer);
    Shaders shaders(tables, state.threads);
    std::vector<std::unique_ptr<Prober>> probers(static_cast<std::size_t>(state.threads));
    Supersampled result{Image<glm::dvec3>(camera.width, camera.height, glm::dvec3(0)),
                        Image<double>(camera.width, camera.height, 0)};
    parallel_for(camera.height, state.threads, [&](int y, int thread) {
        std::unique_ptr<Prober>& prober = probers[static_cast<std::size_t>(thread)];
        if (!prober) prober = std::make_unique<Prober>(state);
        for (int x = 0; x < camera.width; ++x) {
            const Sum sum = sum_of({camera, n, x, y}, *prober, shaders.of(thread), of);
            const double samples = n * n;
            result.color.at(x, y) = sum.color / samples;
            result.coverage.at(x, y) = sum.seen / samples;
        }
    });
    return result;
}

} // namespace

Supersampled shade_supersampled(const Tracer& tracer, int n, const TracedLights& before) {
    Supersampled result = supersampled(
        tracer, n, [](const PointShader& shader, std::size_t lane) { return shader.color(lane); });
    const Image<glm::dvec3> more = sum_over(before, [&](const TracedLight& light) {
        return supersampled(light.tracer, n,
                            [](const PointShader& shader, std::size_t lane) {
                                return shader.added_color(lane);
                            })
            .color;
    });
    add(more, result.color);
    return result;
}

} // namespace shadowproof
