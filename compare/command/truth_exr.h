// The truth as an OpenEXR picture of named channels.
#pragma once

#include "reference/shade/shading.h"

#include <filesystem>

namespace shadowproof {

/// Channels: P.X P.Y P.Z (world units) and N.X N.Y N.Z (unit normal of the seen side), 0 at
/// background; depth.Z (view depth, +infinity at background); visibility.<light> (the class map's
/// value over 255: 0 background, 64/255 shadowed, 1 lit); exactness (0 filtered, 1 exact,
/// 2 degenerate); primId (UINT32, 0xffffffff at background; the others are FLOAT). OpenEXR
/// orders channels by name: look them up by name. By write_file; throws Error.
///
/// With shadings (of scenes with bump maps; else an empty picture) also, 0 at background: R G B,
/// the linear colour, and its summands diffuse.R to B, specular.R to B, ambient.R to B and
/// reflection.R to B; Albedo.R to B, the decal; Ns.X Ns.Y Ns.Z, the bumped normal; T.X T.Y T.Z, the
/// tangent, 0 where a surface has no bump map too.
void write_truth_exr(const Scene& scene, const GroundTruth& truth, const Image<Shading>& shadings,
                     const std::filesystem::path& file);

} // namespace shadowproof
