// Quake II models (.md2) to Scene: key frames posed at a time, in glTF's axes.
#pragma once

#include "scenes/scene.h"
#include "scenes/scene_request.h"

#include <filesystem>

namespace shadowproof {

/// One mesh, which nothing but itself shadows, framed and lit by default (default_view.h).
///
/// - Frames follow each other ten a second, in the file's order, through all its motions, and
///   vertices go straight between them; before the first and after the last that one holds.
/// - The model's z is up and it looks along x: here y is up, and it looks along z. The game's
///   triangles are clockwise from the front, ours counter-clockwise.
/// - No normals are taken: the game's are indices into a table of its own. smooth_normals makes
///   them from the pose.
/// - Skins are in id's .pcx; what counts is a PNG beside the model, with the stem of the first
///   skin's name (without skins, of the model's): STEM_normal.png, a normal map as glTF has it,
///   makes the model bump-lit, and STEM.png is then its decal, else white is its colour. The notes
///   say what was there. The ambient light is then 1/8, the specular colour 1/4: the file says
///   nothing of either.
///
/// Throws Error naming the file, the thing and the remedy.
Scene load_md2(const std::filesystem::path& file, const SceneRequest& request);

} // namespace shadowproof
