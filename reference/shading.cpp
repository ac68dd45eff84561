#include "reference/shading.h"

#include "reference/point_shader.h"
#include "reference/tiles.h"

#include <cassert>
#include <memory>

namespace shadowproof {

namespace {

/// One shader a thread, made where the thread first needs one.
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

/// What `of` makes of the shading of every pixel that sees a surface.
template <class T, class Of>
Image<T> shaded(const Tracer& tracer, const GroundTruth& truth, const Of& of) {
    const Camera& camera = tracer.scene().camera;
    assert(is_bump_lit(tracer.scene()));
    assert(truth.triangle.width == camera.width && truth.triangle.height == camera.height);
    const ShadingTables tables = make_shading_tables(tracer);
    Shaders shaders(tables, tracer.threads());
    const PixelRays rays(camera);
    Image<T> picture(camera.width, camera.height, T{});
    parallel_for(camera.height, tracer.threads(), [&](int y, int thread) {
        PointShader& shader = shaders.of(thread);
        for (int x = 0; x < camera.width; ++x) {
            const std::size_t pixel = picture.index(x, y);
            const std::uint32_t triangle = truth.triangle.pixels[pixel];
            if (triangle == no_triangle) continue;
            const bool lit = truth.visibility.pixels[pixel] == Visibility::lit;
            picture.pixels[pixel] = of(shader.shade(rays.at(x, y), triangle, lit));
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

Sum sum_of(const SampleRays& rays, Prober& prober, PointShader& shader) {
    Sum sum;
    const int samples = rays.n * rays.n;
    for (int first = 0; first < samples; first += packet_size) {
        const int count = std::min(packet_size, samples - first);
        Lanes<glm::dvec3> directions{};
        for (int lane = 0; lane < count; ++lane)
            directions[static_cast<std::size_t>(lane)] = rays.at(first + lane);
        const std::uint32_t lanes = (1U << static_cast<unsigned>(count)) - 1;
        Lanes<Seen> seen;
        Lanes<Lighting> lighting;
        prober.see(directions, lanes, seen);
        prober.light(directions, lanes, seen, lighting);
        for (std::size_t lane = 0; lane < static_cast<std::size_t>(count); ++lane) {
            if (seen[lane].triangle == no_triangle) continue;
            ++sum.seen;
            sum.color +=
                shader.shade(directions[lane], seen[lane].triangle, lighting[lane].lit).color();
        }
    }
    return sum;
}

} // namespace

Image<glm::dvec3> shade(const Tracer& tracer, const GroundTruth& truth) {
    return shaded<glm::dvec3>(tracer, truth,
                              [](const Shading& shading) { return shading.color(); });
}

Image<Shading> shade_terms(const Tracer& tracer, const GroundTruth& truth) {
    return shaded<Shading>(tracer, truth, [](const Shading& shading) { return shading; });
}

std::optional<Shading> shade_ray(const Tracer& tracer, const glm::dvec3& direction) {
    const RayTruth truth = trace_ray(tracer, direction);
    if (truth.triangle == no_triangle) return std::nullopt;
    const ShadingTables tables = make_shading_tables(tracer);
    return PointShader(tables).shade(direction, truth.triangle,
                                     truth.visibility == Visibility::lit);
}

Supersampled shade_supersampled(const Tracer& tracer, int n) {
    const Tracer::State& state = tracer.state();
    const Camera& camera = state.scene->camera;
    assert(is_bump_lit(*state.scene) && n >= 1 && n <= 32);
    const ShadingTables tables = make_shading_tables(tracer);
    Shaders shaders(tables, state.threads);
    std::vector<std::unique_ptr<Prober>> probers(static_cast<std::size_t>(state.threads));
    Supersampled result{Image<glm::dvec3>(camera.width, camera.height, glm::dvec3(0)),
                        Image<double>(camera.width, camera.height, 0)};
    parallel_for(camera.height, state.threads, [&](int y, int thread) {
        std::unique_ptr<Prober>& prober = probers[static_cast<std::size_t>(thread)];
        if (!prober) prober = std::make_unique<Prober>(state);
        for (int x = 0; x < camera.width; ++x) {
            const Sum sum = sum_of({camera, n, x, y}, *prober, shaders.of(thread));
            const double samples = n * n;
            result.color.at(x, y) = sum.color / samples;
            result.coverage.at(x, y) = sum.seen / samples;
        }
    });
    return result;
}

} // namespace shadowproof
