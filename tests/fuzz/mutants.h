// Mutated assets, made of those that lie in folders.
#pragma once

#include "tests/dice.h"
#include "tests/fuzz/asset.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace shadowproof::fuzz {

struct Original {
    std::string extension; ///< ".gltf", ".glb", ".md2", ".png"
    FileBytes bytes;       ///< of a glTF asset with its buffers and pictures embedded
};

/// Files of those kinds below the folders, in the order of their paths. Those of more than 2 MB are
/// left out: they are slow and show nothing else. Throws std::runtime_error where there are none.
std::vector<Original> originals_in(std::span<const std::filesystem::path> folders);

/// Changed in one to four places.
FileBytes mutated(const Original& original, Dice& dice);

} // namespace shadowproof::fuzz
