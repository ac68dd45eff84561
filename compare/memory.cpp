#include "compare/memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace shadowproof {

namespace {

std::uint64_t pixels_of(int width, int height) {
    return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
}

/// Bytes per triangle: the tracer's clusters, trees and planes, and what lighting stores for its
/// corners.
std::uint64_t triangle_bytes(Workload work, bool lit) {
    if (work != Workload::comparison) return lit ? 400 : 150;
    return lit ? 500 : 200;
}

/// Bytes per vertex. If techniques run: half edges, silhouettes, fillings of holes, and volumes in
/// the program and in OpenGL, which in software is in the same memory. All of that goes by edges,
/// of which a closed surface has six for each vertex, and loose triangles, whose every edge is
/// open, one: but then each of them is filled and extruded by itself.
std::uint64_t vertex_bytes(Workload work) {
    return work == Workload::comparison ? 700 : 24;
}

/// Bytes per texel, besides the scene's own 16: what lighting makes of it for the truth, for a
/// technique in another form, and once more in OpenGL.
std::uint64_t texel_bytes(Workload work) {
    return work == Workload::comparison ? 112 : 48;
}

struct Part {
    std::uint64_t bytes = 0;
    std::string name;
    const char* remedy = "";
};

/// Bytes per pixel of each light before the chosen one: its truth and, in the program and in
/// OpenGL, its claim.
constexpr std::uint64_t pixel_bytes_of_light = 20;
/// Once, where there are such lights: the sum of what they add, and what an .exr holds of it.
constexpr std::uint64_t pixel_bytes_of_sum = 24 + 12;

std::array<Part, 3> parts_of(const Scene& scene, Workload work) {
    const bool lit = is_bump_lit(scene);
    std::uint64_t texels = 0;
    for (const TextureImage& texture : scene.textures) texels += texture.texels.pixels.size();
    if (scene.environment)
        for (const auto& face : *scene.environment) texels += face.pixels.size();
    // Beside the scene: in OpenGL, with the casters before each face of a cube, and in volumes of
    // flipped, filled, extruded and left-out casters.
    constexpr std::uint64_t copies_of_masks = 12;
    std::uint64_t of_masks = 0;
    for (const AlphaMask& mask : scene.masks) of_masks += mask.alpha.pixels.size();
    const std::uint64_t pixels = pixels_of(scene.camera.width, scene.camera.height);
    const std::uint64_t triangles = scene.triangles.size();
    const std::uint64_t lights = std::max<std::size_t>(added_lights(scene), 1);
    // Truth and techniques hold the scene once for each light before the chosen one.
    const std::uint64_t copies = 2 * (lights - 1);
    return {Part{pixels * (pixel_bytes(work, lit) + (lights - 1) * pixel_bytes_of_light +
                           (lights > 1 ? pixel_bytes_of_sum : 0)),
                 fmt::format("a picture of {}x{}", scene.camera.width, scene.camera.height),
                 "try a smaller --size"},
            Part{lights * (triangles * triangle_bytes(work, lit) +
                           scene.positions.size() * vertex_bytes(work) +
                           scene.surfaces.size() * sizeof(Surface) * 2),
                 fmt::format("{} triangles", triangles), "give the scene fewer triangles"},
            Part{texels * (texel_bytes(work) + (1 + copies) * sizeof(glm::vec4)) +
                     of_masks * lights * copies_of_masks * sizeof(float),
                 fmt::format("{} texels", texels + of_masks), "make its textures smaller"}};
}

} // namespace

std::size_t pixel_bytes(Workload work, bool lit) {
    switch (work) {
    case Workload::class_map:
        return 24;
    case Workload::truth:
        return 72;
    case Workload::colors:
        return 56;
    case Workload::terms:
        return 494;
    case Workload::lit_truth:
        return 714;
    case Workload::comparison:
        break;
    }
    return lit ? 200 : 110;
}

void require_picture(const MemoryBudget& budget, int width, int height, Workload work) {
    require_memory(budget, program_bytes,
                   {pixels_of(width, height) * pixel_bytes(work, false),
                    fmt::format("--size {}x{}", width, height),
                    fmt::format("{} bytes a pixel", pixel_bytes(work, false)),
                    "try a smaller picture"});
}

std::uint64_t scene_bytes(const Scene& scene, Workload work) {
    std::uint64_t bytes = 0;
    for (const Part& part : parts_of(scene, work)) bytes += part.bytes;
    return bytes;
}

MemoryBudget left_beside(const Scene& scene, Workload work, const MemoryBudget& budget) {
    MemoryAccount account(budget);
    const MemoryHold held(account, scene_bytes(scene, work));
    return account.left();
}

void require_scene(const MemoryBudget& budget, const Scene& scene, Workload work) {
    const std::array<Part, 3> parts = parts_of(scene, work);
    const Part& most = *std::max_element(
        parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.bytes < b.bytes; });
    require_memory(budget, program_bytes,
                   {scene_bytes(scene, work), scene.file.string(),
                    most.name + " and the rest of the work", most.remedy});
}

} // namespace shadowproof
