// Faces that the samples of one pixel share. Snapping moves every corner by itself, so that each
// face may be drawn as in one of the samples, not all as in the same one.
#pragma once

#include "compare/stencil/pixel_faces.h"
#include "reference/predict/prediction.h"

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

namespace shadowproof {

/// A face as samples share it: part, triangle, a side's edge, change.
using FaceKey = std::tuple<Crossing::Part, std::uint32_t, std::uint32_t, int>;
using SharedFaces = std::map<FaceKey, CandidateFace>;

/// The faces that the sample's ray crosses and that may be counted there.
SharedFaces faces_of_sample(const PixelFaces& pixel, const Sample& sample);

/// Adds a sample's faces to those of others; `is_first`: there are none yet. A face stays certain
/// if it is certain in every sample.
void merge(const SharedFaces& sample, bool is_first, SharedFaces& faces);

/// In the order of their keys.
std::vector<PossibleFace> possible_faces(const SharedFaces& faces);

} // namespace shadowproof
