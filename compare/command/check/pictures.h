// The pictures of a scene that are to be judged, read from their files.
#pragma once

#include "compare/command/check/options.h"
#include "compare/command/process/console.h"
#include "compare/picture/reading/observed_colors.h"
#include "scenes/load/picture/picture.h"

#include <string>
#include <vector>

namespace shadowproof {

/// The pictures that are judged, and others of the same view.
struct Pictures {
    std::vector<Picture> pictures{};
    Twins twins{};
    PictureSize size{};
};

/// What is to be judged of a scene: the picture, or the mask that goes with it.
const std::string& judged_file(const SceneInputs& inputs, std::size_t i);

/// All of one size. Throws Error naming the file that has another one, or that cannot be read.
Pictures read_pictures(const CheckOptions& options, const SceneInputs& inputs,
                       MemoryAccount& memory, Console& console, Pieces& pieces);

} // namespace shadowproof
