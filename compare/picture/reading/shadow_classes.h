// The shadows that a picture shows: which of its pixels are lit, which are shadowed, and which are
// undecided. Light and shadow are what the picture itself shows where the truth knows them.
#pragma once

#include "compare/picture/reading/observed_colors.h"
#include "reference/predict/traced_scene.h"
#include "scenes/frame.h"
#include "scenes/load/picture/picture.h"

#include <string>

namespace shadowproof {

/// A renderer's picture of the scene, and perhaps others of the same view.
struct PictureFiles {
    std::string picture;
    std::string mask;       ///< black where shadowed, white where lit; empty: none
    std::string unlit;      ///< without the light; empty: none
    std::string unshadowed; ///< with the light, which nothing shadows; empty: none
};

/// A claim of family "picture". `picture` and `twins` have the size of the scene's camera. By
/// `mask` the picture itself is black and white.
///
/// With both twins each pixel tells by itself what light adds there, and how much of it is shown.
/// Otherwise each mesh has its own colours of shadow and of light (fitted_light), of the picture,
/// or of how it differs from the twin. A pixel is lit or shadowed, whichever is nearer. It is
/// undecided where
///   - its surface faces away from the light, which is dark whatever the picture does;
///   - the picture does not tell what shadow or light looks like there;
///   - light adds too little (MeshLight::least_difference).
///
/// Throws Error, naming the file, where a picture is of one colour, or nowhere distinguishes light
/// from shadow.
Frame read_shadows(const TracedScene& traced, const PictureFiles& files, const Picture& picture,
                   const Twins& twins);

/// What to do about a picture that does not.
std::string advice_on_undecidable(const PictureFiles& files);

} // namespace shadowproof
