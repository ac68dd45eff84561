// An upper bound of the memory that a run takes, apart from reading its scene, estimated from the
// scene and the size of the picture before the work begins. Each figure is measured, with a fifth
// added, and tested by tests/command/peaks_test.mjs: less than a run took is refused, three times
// as much suffices.
#pragma once

#include "scenes/memory_budget.h"
#include "scenes/scene.h"

#include <cstddef>
#include <cstdint>

namespace shadowproof {

/// The message if memory runs out nevertheless.
inline constexpr const char* out_of_memory =
    "there is not enough memory; try a smaller --size, or a smaller scene";

/// What is computed from a scene.
enum class Workload : std::uint8_t {
    class_map,  ///< the truth as a .png
    truth,      ///< the truth as an .exr
    colors,     ///< the truth lit, as a .png
    terms,      ///< normals or tangents of the truth lit, as a .png
    lit_truth,  ///< all of that as an .exr
    comparison, ///< truth, techniques one after the other, their judging and their report
};

/// Bytes for each pixel; `lit`: the scene has bump maps.
std::size_t pixel_bytes(Workload work, bool lit);

/// Throws Error naming --size where a picture of that size cannot fit, whatever its scene.
void require_picture(const MemoryBudget& budget, int width, int height, Workload work);

/// Bytes for all work on a scene at the size of its camera, apart from reading it.
std::uint64_t scene_bytes(const Scene& scene, Workload work);

/// What is left of a budget beside all work on a scene, for what depends on its results.
MemoryBudget left_beside(const Scene& scene, Workload work, const MemoryBudget& budget);

/// Throws Error naming the scene's file and what of it takes most, where the work on it at the size
/// of its camera cannot fit.
void require_scene(const MemoryBudget& budget, const Scene& scene, Workload work);

} // namespace shadowproof
