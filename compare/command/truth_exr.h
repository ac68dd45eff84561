// The truth as an OpenEXR picture of named channels.
#pragma once

#include "reference/trace.h"

#include <filesystem>

namespace shadowproof {

/// Channels: P.X P.Y P.Z (world units) and N.X N.Y N.Z (unit normal of the seen side), 0 at
/// background; depth.Z (view depth, +infinity at background); visibility.<light> (the class map's
/// value over 255: 0 background, 64/255 shadowed, 1 lit); exactness (0 filtered, 1 exact,
/// 2 degenerate); primId (UINT32, 0xffffffff at background; the others are FLOAT). OpenEXR
/// orders channels by name: look them up by name. Written beside and renamed; throws Error.
void write_truth_exr(const Scene& scene, const GroundTruth& truth,
                     const std::filesystem::path& file);

} // namespace shadowproof
