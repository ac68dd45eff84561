// Metamorphic relations: changes of a scene that must not change its picture. They test the truth
// without a second tracer. A change is made only where it is exact: no number of the scene is
// rounded.
#pragma once

#include "scenes/scene.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace shadowproof {

/// A scene that was changed. Its picture has the same pixels; its triangles may have other numbers.
struct ChangedScene {
    Scene scene{};
    std::vector<std::uint32_t> original{}; ///< of each triangle, the one that it is or is part of
};

struct Relation {
    std::string_view name;  ///< "mirrored"
    std::string_view words; ///< what is done, one clause
    /// None where the scene's numbers do not admit it exactly, or it would change nothing.
    std::optional<ChangedScene> (*change)(const Scene& scene) = nullptr;
    /// Whether the camera stays one that OpenGL can have (Camera::right x up = -forward).
    bool keeps_camera_right_handed = true;
};

std::span<const Relation> relations();

} // namespace shadowproof
