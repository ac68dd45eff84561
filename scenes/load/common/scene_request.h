// How a scene is to be loaded, whatever its file's format.
#pragma once

#include "scenes/memory_budget.h"
#include "scenes/stress/parameter.h"

#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

namespace shadowproof {

/// A view that replaces the file's, for pictures by renderers that do not use the file's own.
struct ViewOverride {
    /// The camera's node, column by column as glTF and OpenGL write matrices: it looks down its -z,
    /// with its y up. In the file's axes and units.
    std::optional<std::array<double, 16>> camera_matrix{};
    std::optional<glm::dvec3> light_position{};     ///< of the light that is judged; file's units
    std::optional<double> vertical_field_of_view{}; ///< radians, between 0 and pi
    std::optional<double> orthographic_height{};    ///< of an orthographic camera's picture, in the
                                                    ///< file's units, above 0; not with the other
};

/// What to take from a file that offers several.
struct SceneRequest {
    std::optional<std::string> camera; ///< name or index of a camera node; else the first
    std::optional<std::string> light;  ///< name or index of a light; else the first
    bool every_light = false;          ///< all lights are judged, each by itself: no note then says
                                       ///< that the first was taken
    bool floor = false;                ///< under a model without camera or light (default_floor.h)
    double time = 0;                   ///< seconds: animations, skins and morphs are posed here
    int width = 512;                   ///< pixels
    int height = 512;                  ///< pixels
    bool camera_aspect = false;     ///< the picture is as wide as the camera's aspect ratio says,
                                    ///< where it says one, rather than `width`
    bool normals = false;           ///< whether Scene::normals are wanted
    ViewOverride view{};            ///< applied once the file is read, before the stress
    std::optional<Stress> stress{}; ///< applied once the scene is read
    MemoryBudget memory{};          ///< of the run: files that need more to be read are refused
};

} // namespace shadowproof
