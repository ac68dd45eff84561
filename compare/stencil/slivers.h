// Faces of volumes that are slivers in the picture, and that no ray meets: snapping may make them
// cover a pixel all the same, either way round. Those in which floats may find no area: a side over
// an edge that points at the light, a dark cap at infinity of a triangle that the light sees
// edge-on. Their depth there may be anything, also where that of all corners is the same: the
// driver divides by the area. And layers in the near plane, drawn from the light, that snapping may
// flip.
#pragma once

#include "compare/driver/setup_error.h"
#include "reference/predict/volumes.h"
#include "scenes/frame.h"

#include <array>
#include <cstdint>
#include <mutex>
#include <vector>

namespace shadowproof {

/// Of one technique's volumes. Found when they are first asked for, in time O(n log n) in the
/// casters' triangles. For several threads.
class Slivers {
public:
    /// How many may be drawn at a pixel.
    struct Number {
        std::int64_t sides = 0;  ///< each counts once at most
        std::int64_t caps = 0;   ///< without light caps of what is seen
        std::int64_t layers = 0; ///< with which the counter begins, each counted if it is drawn
    };

    /// Keeps references to all. `volumes`: those that the frame's technique counts; `far`: the far
    /// plane of techniques that have a finite one.
    Slivers(const Scene& scene, const Volumes& volumes, const Frame& frame, double far)
        : scene_(scene), volumes_(volumes), frame_(frame), far_(far) {}

    Number at(const CoveredPixel& pixel) const;

private:
    struct Sliver {
        std::int64_t Number::*kind; ///< as what it counts
        std::uint32_t copies = 1;
        std::vector<std::array<PicturePoint, 3>> parts{}; ///< triangles that are set up
    };

    const Scene& scene_;
    const Volumes& volumes_;
    const Frame& frame_;
    double far_;
    mutable std::once_flag found_;
    mutable std::vector<Sliver> slivers_;

    std::vector<Sliver> find() const;
};

} // namespace shadowproof
