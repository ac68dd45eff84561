// A scene's camera and light in an engine's convention, as numbers and matrices.
#pragma once

#include "scenes/engines/convention.h"
#include "scenes/scene.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <optional>

namespace shadowproof {

/// Lengths are the engine's, matrices for column vectors.
struct EngineView {
    glm::dmat4 world_from_gltf{1};
    glm::dmat4 world_from_camera{1}; ///< the camera's node: rotation and position
    glm::dmat4 view_from_world{1};
    glm::dmat4 clip_from_view{1}; ///< x and y to the right and up
    glm::dvec3 position{0, 0, 0};
    glm::dquat rotation{1, 0, 0, 0};     ///< of the camera's node
    double vertical_field_of_view = 0;   ///< radians; 0 where the camera is orthographic
    double horizontal_field_of_view = 0; ///< radians; likewise
    std::optional<glm::dvec2> extent{};  ///< of an orthographic camera: the picture's width and
                                         ///< height, in the engine's units
    double near = 0;
    std::optional<double> far{}; ///< none: there is no far plane
    bool far_is_made_up = false; ///< the scene has no far plane, but the engine needs one
    glm::dvec3 light_position{0, 0, 0};
    glm::dvec3 light_direction{0, 0, -1};  ///< meaningless for a point light
    glm::dquat light_rotation{1, 0, 0, 0}; ///< of a node that looks in that direction as cameras do
};

/// `scene` is in the file's units. An engine that needs a far plane gets one at twice the depth of
/// the farthest vertex, which cuts nothing.
EngineView view_in(const Convention& convention, const Scene& scene);

} // namespace shadowproof
