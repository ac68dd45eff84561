// What Google's Draco does. Its library has a tinygltf of its own, another than ours, and exports
// its symbols; so it is part of a module, which shows none of them.
#pragma once

#include "scenes/load/compressed/draco.h"

#include <string>

namespace shadowproof {

/// What is wrong with a stream; no words where nothing is.
struct DracoFault {
    static constexpr std::uint64_t no_part = ~std::uint64_t{0};
    std::string words;
    std::uint64_t part = no_part; ///< index into DracoMesh::parts of what it is about
};

struct DracoLibrary {
    /// Writes the parts of a mesh to `target`, one after the other, each as long as it says. May
    /// crash on a damaged stream.
    DracoFault (*decode)(const DracoMesh& mesh, unsigned char* target);
};

/// The name under which the module exports a function that returns them. Its number changes with
/// what passes between both.
inline constexpr const char* draco_entry = "shadowproof_draco_1";

} // namespace shadowproof
