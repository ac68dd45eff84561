// The pictures that a Quake II model wears.
#pragma once

#include "scenes/load/md2/md2_file.h"
#include "scenes/memory_budget.h"
#include "scenes/scene.h"

namespace shadowproof::md2 {

/// Adds the one material of the model, and the textures found beside its file. They are named by
/// the stem of the first skin's name (without skins, of the model's):
///
/// - STEM_normal.png, a normal map as in glTF, or else STEM_height.png, a height field whose white
///   is 8 texels high, make the model bump-lit; without them nothing else is read.
/// - STEM.png is its decal, or else STEM.pcx, the game's own skin; without both it is white.
/// - STEM_gloss.png, whose gray is the decal's alpha, is times the specular colour.
///
/// The ambient light is then 1/8, the specular colour 1/4: the file gives neither. The notes say
/// what was there. Throws Error naming the picture and the remedy.
void dress(const Model& model, MemoryAccount& memory, Scene& scene);

} // namespace shadowproof::md2
