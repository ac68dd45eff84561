// Quake II models (.md2) to Scene: key frames interpolated at a given time, in glTF's axes.
#pragma once

#include "scenes/load/common/scene_request.h"
#include "scenes/scene.h"

#include <filesystem>

namespace shadowproof {

/// One mesh alone in the scene, with the default camera and light (default_view.h).
///
/// - The frames follow each other at ten per second, in the file's order, through all its motions.
///   Vertices move on straight lines between them; before the first and after the last frame that
///   one holds.
/// - In the model z is up and it looks along x; here y is up and it looks along z. The game's
///   triangles are clockwise from the front, ours counter-clockwise.
/// - The file's normals, indices into the game's own table, are not read. smooth_normals makes
///   normals from the pose.
/// - It wears the pictures that lie beside it (skins.h).
///
/// Throws Error naming the file, the thing and the remedy.
Scene load_md2(const std::filesystem::path& file, const SceneRequest& request);

} // namespace shadowproof
