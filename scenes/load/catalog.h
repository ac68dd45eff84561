// The bundled scenes by name.
#pragma once

#include "scenes/load/common/scene_request.h"
#include "scenes/scene.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace shadowproof {

struct BundledScene {
    std::string_view name;    ///< "near_plane"
    std::string_view summary; ///< one clause: what it shows
};

/// In the order in which they are verified.
const std::vector<BundledScene>& bundled_scenes();

bool is_bundled(std::string_view name);

/// Folder of the .gltf files: $SHADOWPROOF_SCENES, else beside the installed program, else the
/// source tree. Throws Error when none of them holds the scenes.
std::filesystem::path bundled_folder();

/// A SCENE argument: a bundled name or a path to .gltf, .glb or .md2. Throws Error with the bundled
/// names when it is neither, and where its coordinates are not admitted (admission.h).
Scene load_scene(const std::string& name_or_path, const SceneRequest& request);

} // namespace shadowproof
