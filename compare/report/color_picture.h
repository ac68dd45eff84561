// Colours, normals and tangents as pictures for viewing.
#pragma once

#include "compare/color/color_check.h"
#include "compare/report/png.h"
#include "reference/shade/shading.h"

namespace shadowproof {

/// Linear to sRGB (IEC 61966-2-1), clamped to what 8 bits hold.
Image<Rgb> color_picture(const Image<glm::dvec3>& linear);
Image<Rgb> color_picture(const Image<glm::vec3>& linear);

/// The bumped normals as normal maps show them, in world space: 0.5 + 0.5 n. Background is black.
Image<Rgb> normal_picture(const Image<Shading>& shadings);

/// The tangents in the same way; black also where a surface has no bump map. Where they jump, so
/// does the frame that a bump map is read in.
Image<Rgb> tangent_picture(const Image<Shading>& shadings);

/// A direction of the pixels, in tangent space, where bump maps are read: its parts along tangent,
/// bitangent and the front's normal, negated where the back is seen, as techniques have it; in the
/// same way. Interpolation between vertices is good where it is smooth.
Image<Rgb> tangent_space_picture(const Image<Shading>& shadings, glm::dvec3 Shading::*direction);

} // namespace shadowproof
