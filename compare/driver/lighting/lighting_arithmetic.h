// Computes colours from lighting inputs, as intervals: those that a technique's own arithmetic
// gives, step by step, and those that its error budget allows around the truth.
#pragma once

#include "compare/driver/lighting/lighting_inputs.h"

namespace shadowproof {

/// The colours that the technique's own arithmetic may give, linear. Within [0, 1] where it keeps 8
/// bits.
Intervals predicted_color(const ColorModel& model, AddedInputs claimed);

/// The colours that the error budget (error_budget.h) explains: the definition in shading.h,
/// evaluated in the technique's stages. Where the technique keeps 8 bits, each stage is off by up
/// to half a step, and the colour is clamped to [0, 1].
Intervals color_bound(const ColorModel& model, AddedInputs budgeted);

/// Whether a technique of this model is off by nature on the scene, whatever its numbers: it
/// filters; its vectors are not made as the truth's are; or heights are in units of space, and it
/// takes all texels for squares of one size, as tangent space and normal maps do.
bool is_off_by_nature(const ColorModel& model, const Scene& scene);

/// Whether the technique uses floats alone, without bytes and tables, and is not off by nature. A
/// colour of such a technique is wrong if it is beyond 1/255 of the truth.
bool is_exact(const ColorModel& model, const Scene& scene);

/// The truth's colour as a technique of this model can show it: clamped to [0, 1] where it keeps 8
/// bits.
glm::dvec3 showable(const ColorModel& model, const glm::dvec3& color);

} // namespace shadowproof
