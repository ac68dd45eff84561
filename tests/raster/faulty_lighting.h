// What renderers get wrong when they light bump maps, one fault each: in the scene that is drawn,
// or in a fragment shader, of which one piece is replaced by another. They declare the same as the
// right ones do.
#pragma once

#include "raster/gl/context.h"
#include "raster/technique.h"

#include <ostream>
#include <span>

namespace shadowproof::tests {

struct LightingFault {
    const char* name;
    const char* scene;                            ///< a bundled one on which it shows
    const char* technique = "bump_tangent_space"; ///< pieces are replaced in it, in the eye's, or
                                                  ///< in what bump_reflective adds
    void (*in_scene)(Scene& scene) = nullptr;
    const char* right = nullptr; ///< a piece of the shader, and what stands in its stead
    const char* wrong = nullptr;
};

std::ostream& operator<<(std::ostream& out, const LightingFault& fault);

std::span<const LightingFault> lighting_faults();

/// Throws std::logic_error where the shader no longer holds the piece that is to be replaced.
Frame draw_faulty(Gpu& gpu, const Scene& scene, const Plan& plan, const LightingFault& fault);

} // namespace shadowproof::tests
