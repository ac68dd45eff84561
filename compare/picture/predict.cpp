#include "compare/picture/predict.h"

#include "scenes/camera.h"

#include <numeric>
#include <utility>

namespace shadowproof {

namespace {

std::size_t index_of(const Image<Visibility>& picture, int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
           static_cast<std::size_t>(x);
}

/// Meshes of the triangles in two parts: those for which `first` holds, and the others; `made`
/// takes the mesh of a part and whether it is the first.
void part_meshes(const Scene& scene, const std::function<bool(std::uint32_t)>& first, Scene& parted,
                 const std::function<bool(Mesh&, bool)>& made) {
    parted.triangles.clear();
    parted.surfaces.clear();
    parted.meshes.clear();
    for (const Mesh& mesh : scene.meshes)
        for (const bool is_first : {true, false}) {
            Mesh part = mesh;
            if (!made(part, is_first)) continue;
            part.first_triangle = static_cast<std::uint32_t>(parted.triangles.size());
            for (std::uint32_t i = 0; i < mesh.triangle_count; ++i)
                if (first(mesh.first_triangle + i) == is_first)
                    parted.triangles.push_back(scene.triangles[mesh.first_triangle + i]);
            part.triangle_count =
                static_cast<std::uint32_t>(parted.triangles.size()) - part.first_triangle;
            if (part.triangle_count > 0) parted.meshes.push_back(part);
        }
}

} // namespace

Predict changed(const TracedScene& traced,
                std::function<Visibility(std::size_t pixel, Visibility truth)> change) {
    return [&traced, change = std::move(change)](std::span<const Patch> patches,
                                                 Image<Visibility>& picture) {
        for (const Patch& patch : patches)
            for_each_pixel(patch, [&](int x, int y) {
                const std::size_t i = index_of(picture, x, y);
                if (faces_light(traced, i))
                    picture.pixels[i] = change(i, traced.truth().visibility.pixels[i]);
            });
    };
}

Predict truth_of(std::function<Scene()> make, int threads) {
    return [make = std::move(make), threads](std::span<const Patch> patches,
                                             Image<Visibility>& picture) {
        const Scene scene = make();
        if (scene.triangles.empty()) {
            for (const Patch& patch : patches)
                for_each_pixel(patch,
                               [&](int x, int y) { picture.at(x, y) = Visibility::background; });
            return;
        }
        const Tracer tracer(scene, threads);
        const std::size_t pixels =
            std::accumulate(patches.begin(), patches.end(), std::size_t{0},
                            [](std::size_t sum, const Patch& patch) { return sum + area(patch); });
        if (pixels == picture.pixels.size()) { // without a ray's answers for each pixel in memory
            picture = trace(tracer).visibility;
            return;
        }
        std::vector<glm::dvec3> lines;
        lines.reserve(pixels);
        for (const Patch& patch : patches)
            for_each_pixel(patch, [&](int x, int y) {
                lines.push_back(line_of_sight(scene.camera, x + 0.5, y + 0.5));
            });
        const std::vector<RayTruth> answers = trace_rays(tracer, lines);
        auto answer = answers.begin();
        for (const Patch& patch : patches)
            for_each_pixel(patch, [&](int x, int y) { picture.at(x, y) = (answer++)->visibility; });
    };
}

bool faces_light(const TracedScene& traced, std::size_t pixel) {
    const std::uint32_t triangle = traced.truth().triangle.pixels[pixel];
    return triangle != no_triangle && sides_of(traced.tracer(), triangle).faces_light();
}

bool in_cone(const GroundTruth& truth, std::size_t pixel) {
    return truth.in_cone.pixels.empty() || truth.in_cone.pixels[pixel] != 0;
}

bool may_be_lit(const TracedScene& traced, std::size_t pixel) {
    return faces_light(traced, pixel) && in_cone(traced.truth(), pixel);
}

glm::dvec3 seen_point(const TracedScene& traced, int x, int y) {
    const Camera& camera = traced.scene().camera;
    return point_on(camera, line_of_sight(camera, x + 0.5, y + 0.5), traced.truth().depth.at(x, y));
}

Scene cast_by(const Scene& scene, const std::function<bool(std::uint32_t)>& casts) {
    Scene parted = scene;
    part_meshes(scene, casts, parted, [](Mesh& part, bool is_first) {
        part.casts = part.casts && is_first;
        return true;
    });
    return parted;
}

Scene kept_by(const Scene& scene, const std::function<bool(std::uint32_t)>& keeps) {
    Scene parted = scene;
    part_meshes(scene, keeps, parted, [](Mesh&, bool is_first) { return is_first; });
    return parted;
}

} // namespace shadowproof
