// Checks the figures and the picture that a report shows of a technique's volumes against what its
// faces must give.
#pragma once

#include "compare/stencil/figures/figure_range.h"
#include "reference/predict/volumes.h"

#include <cstdint>
#include <optional>
#include <string>

namespace shadowproof {

/// A figure that is shown, and its predicted range.
struct CheckedFigure {
    std::uint64_t shown = 0;
    FigureRange predicted{};

    bool holds() const { return predicted.holds(shown); }
};

/// A pixel at which the picture of the volumes shows a number of faces out of the predicted range.
struct WrongFaces {
    int x = 0;
    int y = 0;
    CheckedFigure faces;
};

struct VolumeCheck {
    std::uint64_t checked = 0;       ///< pixels of the picture of the volumes
    std::uint64_t unexplained = 0;   ///< of them
    std::optional<WrongFaces> first; ///< the first of those, in rows from the top
    CheckedFigure fragments;
    std::optional<CheckedFigure> against; ///< of the technique with which Frame::saved compares

    /// Whether all that is shown is as predicted. If not, the cell always fails.
    bool holds() const {
        return unexplained == 0 && fragments.holds() && (!against || against->holds());
    }
};

/// `far`: of techniques that have a finite far plane. `volumes`: those that the frame counts, of
/// the tracer's scene.
VolumeCheck check_volumes(const Tracer& tracer, const Silhouette& silhouette,
                          const Volumes& volumes, const Frame& frame, double far);

/// What is wrong, in one clause each: "volume_fragments is 2,408 where 1,204 to 1,210 are
/// predicted"; empty where all holds.
std::string words_of(const VolumeCheck& check);

} // namespace shadowproof
