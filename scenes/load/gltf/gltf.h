// glTF 2.0 (.gltf and .glb) to Scene. Everything in the file is checked before it is used; URIs
// stay inside the asset's folder.
#pragma once

#include "scenes/load/common/scene_request.h"
#include "scenes/scene.h"

#include <filesystem>

namespace shadowproof {

/// Throws Error naming the file, the JSON pointer of the thing, and the remedy.
Scene load_gltf(const std::filesystem::path& file, const SceneRequest& request);

} // namespace shadowproof
