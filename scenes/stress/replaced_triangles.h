// Other triangles in place of those of some meshes.
#pragma once

#include "scenes/error.h"
#include "scenes/scene.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

namespace shadowproof {

/// Larger scenes would take longer and test nothing more.
inline constexpr std::size_t most_triangles = 2'000'000;

/// Gives every triangle of some meshes others instead. `split` takes its number and appends them.
template <class Includes, class Split>
void replace_triangles(Scene& scene, const Includes& includes, const Split& split) {
    std::vector<glm::uvec3> triangles;
    for (Mesh& mesh : scene.meshes) {
        const auto first = static_cast<std::uint32_t>(triangles.size());
        for (std::uint32_t i = 0; i < mesh.triangle_count; ++i) {
            const std::uint32_t number = mesh.first_triangle + i;
            if (includes(mesh))
                split(number, triangles);
            else
                triangles.push_back(scene.triangles[number]);
            if (triangles.size() > most_triangles)
                throw Error(scene.name,
                            fmt::format("would have more than {} triangles", most_triangles),
                            "take a smaller value, or a simpler scene");
        }
        mesh.first_triangle = first;
        mesh.triangle_count = static_cast<std::uint32_t>(triangles.size()) - first;
    }
    scene.triangles = std::move(triangles);
}

} // namespace shadowproof
