// The shadows that a picture shows: which of its pixels are lit, which are shadowed, and which it
// does not tell. No threshold is tuned: light and shadow are what the picture itself shows where
// the truth knows them.
#pragma once

#include "reference/predict/traced_scene.h"
#include "scenes/frame.h"
#include "scenes/load/picture.h"

#include <optional>
#include <string>

namespace shadowproof {

/// Somebody's picture of the scene, and perhaps another one of the same view.
struct PictureFiles {
    std::string picture;
    std::string mask;  ///< black where shadowed, white where lit; empty: none
    std::string unlit; ///< without the light, or without its shadows; empty: none
};

/// A claim of family "picture". `picture`, and `twin` where there is one, have the size of the
/// scene's camera. By `mask` the picture itself is black and white.
///
/// Light and shadow are fitted per mesh, whatever is true of its pixels. Shadow is what surfaces
/// show that are averted from the light or, where none are seen, the darker of two groups of
/// brightness; with a twin it is no difference. Light is what is brighter, by the angle at which it
/// falls. A pixel's class is the nearer of the two. Where they lie no further apart than two steps
/// of the file's integers and four times what shadows scatter, or where one is missing, the pixel
/// is not decided. Neither is one whose surface is averted: it is dark in any case.
///
/// Throws Error, naming the file, where a picture is of one colour, or tells light from shadow
/// nowhere.
Frame read_shadows(const TracedScene& traced, const PictureFiles& files, const Picture& picture,
                   const std::optional<Picture>& twin);

} // namespace shadowproof
