// The shadows that a picture shows: which of its pixels are lit, which are shadowed, and which are
// undecided. No threshold is tuned: light and shadow are what the picture itself shows where the
// truth knows them.
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
    std::string unlit; ///< without the light, or without its shadows; empty: none
};

/// A claim of family "picture". `picture`, and `twin` where there is one, have the size of the
/// scene's camera. By `mask` the picture itself is black and white.
///
/// Each mesh has its own colours of shadow and of light, fitted to all of its pixels without regard
/// to whether they are truly lit:
///   shadow  the typical colour of surfaces that face away from the light; where none is seen, of
///           the darker of two groups of pixels. With a twin, values are differences, and it is 0
///   light   the typical colour of brighter pixels, for each angle at which the light falls; even
///           between angles, and down to shadow where the light only grazes
/// A pixel is lit or shadowed, whichever colour is nearer. It is undecided where
///   - its surface faces away from the light, which is dark whatever the picture does;
///   - one of the two colours is missing;
///   - they differ by no more than two steps of the file's integers plus four times the scatter of
///     the shadow's pixels.
///
/// Throws Error, naming the file, where a picture is of one colour, or nowhere distinguishes light
/// from shadow.
Frame read_shadows(const TracedScene& traced, const PictureFiles& files, const Picture& picture,
                   const std::optional<Picture>& twin);

} // namespace shadowproof
