// The functions of Google's Draco library. It contains another version of tinygltf than ours and
// exports its symbols; so it is linked into a module that hides them.
#pragma once

#include "scenes/load/compressed/draco.h"

#include <string>

namespace shadowproof {

/// What is wrong with a stream; `words` is empty where nothing is.
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

/// The name under which the module exports a function that returns a DracoLibrary. Its number
/// changes whenever this interface does.
inline constexpr const char* draco_entry = "shadowproof_draco_1";

} // namespace shadowproof
