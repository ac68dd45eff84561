// The shadows that a picture shows: which of its pixels are lit, which are shadowed, and which are
// undecided. Light and shadow are what the picture itself shows where the truth knows them.
#pragma once

#include "reference/predict/traced_scene.h"
#include "scenes/frame.h"
#include "scenes/load/picture/picture.h"

#include <optional>
#include <string>

namespace shadowproof {

/// A renderer's picture of the scene, and perhaps another one of the same view.
struct PictureFiles {
    std::string picture;
    std::string mask;  ///< black where shadowed, white where lit; empty: none
    std::string unlit; ///< without the light; empty: none
};

/// A claim of family "picture". `picture`, and `twin` where there is one, have the size of the
/// scene's camera. By `mask` the picture itself is black and white.
///
/// Each mesh has its own colours of shadow and of light (fitted_light). A pixel is lit or shadowed,
/// whichever is nearer. It is undecided where
///   - its surface faces away from the light, which is dark whatever the picture does;
///   - the picture does not tell what shadow or light looks like there;
///   - light adds too little (MeshLight::least_difference).
///
/// Throws Error, naming the file, where a picture is of one colour, or nowhere distinguishes light
/// from shadow.
Frame read_shadows(const TracedScene& traced, const PictureFiles& files, const Picture& picture,
                   const std::optional<Picture>& twin);

/// What to do about a picture that does not.
std::string advice_on_undecidable(bool with_twin);

} // namespace shadowproof
