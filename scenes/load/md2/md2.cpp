#include "scenes/load/md2/md2.h"

#include "scenes/error.h"
#include "scenes/limits.h"
#include "scenes/load/common/default_floor.h"
#include "scenes/load/common/default_view.h"
#include "scenes/load/md2/md2_file.h"
#include "scenes/load/md2/skins.h"
#include "scenes/mesh/smooth_normals.h"
#include "scenes/surface/tangents.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace shadowproof {

namespace {

using namespace md2;

constexpr double frames_a_second = 10; // as the game plays them

/// Our axes are theirs in cyclic order: a rotation, so nothing is mirrored.
glm::dvec3 y_up(const glm::dvec3& v) {
    return {v.y, v.z, v.x};
}

/// All vertices at a given time, and a note of which frames it lies between.
std::vector<glm::dvec3> pose(const Model& model, double time, std::vector<std::string>& notes) {
    const double last = model.frame_count - 1;
    const double at = std::max(0.0, std::min(last, time * frames_a_second)); // NaN: last
    const auto first = static_cast<std::uint32_t>(at);
    const double share = at - first;
    const Frame from = read_frame(model, first);
    std::vector<glm::dvec3> positions = from.positions;
    std::string where = fmt::format("frame {} \"{}\"", first, from.name);
    if (share > 0) {
        const Frame to = read_frame(model, first + 1);
        for (std::size_t i = 0; i < positions.size(); ++i)
            positions[i] = (1 - share) * from.positions[i] + share * to.positions[i];
        where = fmt::format("{:.3g} of the way from {} to frame {} \"{}\"", share, where, first + 1,
                            to.name);
    }
    if (model.frame_count > 1)
        notes.push_back(fmt::format("posed at {} s, {} ({} frames, {} a second)", time, where,
                                    model.frame_count, frames_a_second));
    for (glm::dvec3& position : positions) position = y_up(position);
    return positions;
}

/// Texel centres are at .5, as the game's tools have it.
glm::vec2 coordinates_of(const Model& model, std::uint32_t place) {
    return glm::vec2((glm::dvec2(model.places[place]) + 0.5) / glm::dvec2(model.size));
}

void append_surfaces(const Model& model, const std::vector<glm::dvec3>& positions,
                     MemoryAccount& memory, Scene& scene) {
    if (model.triangles.size() > limits.surfaces)
        throw Error(
            model.file,
            fmt::format("has more than {} triangles, too many for bump maps", limits.surfaces),
            "split the model, or take its bump map away");
    memory.keep({3 * model.triangles.size() *
                     (tangent_bytes + 2 * sizeof(TexturedCorner) + 3 * sizeof(Surface)),
                 model.file, "its corners' normals and tangents",
                 "split the model, or take its bump map away"});
    const std::vector<glm::dvec3> normals = smooth_normals(positions, scene.triangles);
    std::vector<TexturedCorner> corners;
    for (std::size_t i = 0; i < model.triangles.size(); ++i)
        for (const std::size_t k : {0U, 2U, 1U}) { // counter-clockwise
            const Corner& corner = model.triangles[i].corners[k];
            corners.push_back({scene.positions[corner.vertex], glm::vec3(normals[corner.vertex]),
                               coordinates_of(model, corner.place)});
        }
    const std::vector<glm::vec4> tangents = make_tangents(corners);
    for (std::size_t i = 0; i < corners.size(); ++i)
        scene.surfaces.push_back({corners[i].normal, tangents[i], corners[i].at, corners[i].at});
}

void refuse_choices(const SceneRequest& request, const std::string& file) {
    if (request.camera)
        throw Error(file, fmt::format("has no camera \"{}\"", *request.camera),
                    "a Quake II model has none: leave --camera out");
    if (request.light)
        throw Error(file, fmt::format("has no light \"{}\"", *request.light),
                    "a Quake II model has none: leave --light out");
}

} // namespace

Scene load_md2(const std::filesystem::path& file, const SceneRequest& request) {
    MemoryAccount memory(request.memory);
    const Model model = read_model(file, memory);
    refuse_choices(request, model.file);
    Scene scene;
    scene.name = file.stem().string();
    scene.file = file;
    // Per vertex: two frames and their blend, a normal, and what is kept of it; growing vectors
    // take three times as much.
    constexpr std::uint64_t vertex = 4 * sizeof(glm::dvec3) + 3 * sizeof(glm::vec3);
    memory.keep({vertex * model.vertex_count + 3 * sizeof(glm::uvec3) * model.triangles.size(),
                 model.file, "its triangles", "split the model"});
    const std::vector<glm::dvec3> positions = pose(model, request.time, scene.notes);
    for (const glm::dvec3& position : positions) scene.positions.emplace_back(position);
    for (const Triangle& triangle : model.triangles)
        scene.triangles.emplace_back(triangle.corners[0].vertex, triangle.corners[2].vertex,
                                     triangle.corners[1].vertex);
    dress(model, memory, scene);
    scene.meshes.push_back({.name = scene.name,
                            .triangle_count = static_cast<std::uint32_t>(scene.triangles.size()),
                            .textured = true});
    if (scene.materials[0].bump != Bump::none) append_surfaces(model, positions, memory, scene);
    scene.camera = default_camera(request, scene);
    add_default_light(scene);
    if (request.floor) add_default_floor(scene);
    return scene;
}

} // namespace shadowproof
