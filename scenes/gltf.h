// glTF 2.0 (.gltf and .glb) to Scene. Everything in the file is checked before it is used; URIs
// stay inside the asset's folder.
#pragma once

#include "scenes/scene.h"

#include <filesystem>
#include <optional>
#include <string>

namespace shadowproof {

/// What to take from a file that offers several.
struct SceneRequest {
    std::optional<std::string> camera; ///< name or index of a camera node; else the first
    std::optional<std::string> light;  ///< name or index of a light; else the first
    bool every_light = false;          ///< all lights are judged, each by itself: the first is not
                                       ///< said to be the one
    double time = 0;                   ///< seconds: animations, skins and morphs are posed here
    int width = 512;                   ///< pixels
    int height = 512;                  ///< pixels
};

/// Throws Error naming the file, the JSON pointer of the thing, and the remedy.
Scene load_gltf(const std::filesystem::path& file, const SceneRequest& request);

} // namespace shadowproof
