// How light and shadow show in a picture, or in how it differs from others of the same view.
#pragma once

#include "compare/picture/reading/seen_pixels.h"
#include "scenes/load/picture/picture.h"

#include <optional>

namespace shadowproof {

/// Pictures of the same view, with another light.
struct Twins {
    std::optional<Picture> unlit;      ///< without the light
    std::optional<Picture> unshadowed; ///< with the light, which nothing shadows
};

/// What one step of the files' integers in all three channels changes a colour by; 0 of floats.
double step_of(const Picture& picture, const Twins& twins);

/// The same where a file has floats, of a brightness: Radiance files have eight bits, which is
/// fewer than others.
double float_step(double brightness);

/// Fills in Observed::value of all pixels: the colour; with `twin`, how it differs from the twin's.
/// Where a surface shows in the twin, the difference is measured by that, so that surfaces of all
/// colours are alike.
/// Observed::step is a step of the files, or as much more as noise takes: fewest_steps of it are
/// beyond what the pictures differ by where they should be alike, as pixels certainly `alike` are.
void observe(const Picture& picture, const Picture* twin, double step, Visibility alike,
             SeenPixels& pixels);

} // namespace shadowproof
