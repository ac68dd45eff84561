// Where a picture's shadows begin and end: steps, along the borders of a shadow map's texels. How
// often they return tells how large the texels are.
#pragma once

#include "compare/picture/light_sampling.h"
#include "compare/picture/trial.h"

#include <array>
#include <complex>
#include <glm/vec2.hpp>
#include <limits>
#include <vector>

namespace shadowproof {

/// Between two neighbouring pixels of one surface light ends, or begins: between them a border of
/// texels passes.
struct ShadowStep {
    glm::dvec2 middle{0, 0};
    glm::dvec2 apart{0, 0}; ///< of the pixels' places
    /// How likely it is that the border is one in x, or in y.
    glm::dvec2 weight() const { return apart / (apart.x + apart.y); }
};

/// All of them in a picture, as places that a light's camera sees.
struct ShadowSteps {
    LightAxes axes;
    std::vector<ShadowStep> steps;
    double apart = 0; ///< the places of neighbouring pixels, of a quarter of the steps
    glm::dvec2 low{std::numeric_limits<double>::infinity()};
    glm::dvec2 high{-std::numeric_limits<double>::infinity()};
};

ShadowSteps shadow_steps(const Trial& trial, const LightAxes& axes);

/// How well borders with so many texels to a unit explain the steps: the weights' means as they
/// turn with the place (a Fourier transform of the steps).
struct Wave {
    double frequency = 0; ///< texels to a unit
    std::array<std::complex<double>, 2> mean{};
    double power() const { return std::norm(mean[0]) + std::norm(mean[1]); }
};

/// `count` waves, at equal distances of their frequencies.
std::vector<Wave> waves_of(const ShadowSteps& steps, double first, double step, int count);

/// The `most` waves that stand out most among those around them; none is exceeded by a neighbour.
/// Strength alone does not tell: waves as long as the shadows are apart are always strong.
std::vector<Wave> peaks(const std::vector<Wave>& waves, std::size_t most);

} // namespace shadowproof
