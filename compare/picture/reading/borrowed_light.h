// Light and shadow of a mesh that shows light alone, by another one that is lit as it is.
#pragma once

#include "compare/picture/reading/mesh_light.h"

#include <span>
#include <vector>

namespace shadowproof {

/// What a mesh shows in light.
struct LitSamples {
    /// Of each group of pixels that are certainly lit at about one angle, the one of median
    /// brightness: no few false shadows make it otherwise. By growing angles.
    std::vector<const Observed*> pixels;
    double step = 0; ///< of the file, typical
};

LitSamples lit_samples(std::span<const Observed* const> pixels);

/// A mesh whose light and shadow are known.
struct KnownLight {
    std::vector<MeshLight> fits; ///< without highlights
    LitSamples lit;
};

/// Of one that has both. Highlights of another mesh lie at other angles.
KnownLight known_light(std::vector<MeshLight> fits, std::span<const Observed* const> pixels);

/// The fits of that mesh whose material shows the same colours at the same angles: at two or more,
/// as at one angle two materials may look alike. None where there is no such mesh.
std::vector<MeshLight> borrowed_light(const LitSamples& lit, std::span<const KnownLight> known);

} // namespace shadowproof
