// Writes once what several cells of a scene have alike: techniques that make the same volumes have
// the same pictures, and many of the same blocks.
#pragma once

#include "compare/output/replaced_folder.h"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace shadowproof {

/// The files of one cell.
struct CellFiles {
    std::string script;                 ///< cell.js
    std::vector<std::string*> pictures; ///< paths, each changed where an earlier file is the same
};

struct SceneFiles {
    std::string folder;
    std::vector<CellFiles> cells; ///< in the order of the results
};

/// Removes pictures that are the same as an earlier one of the scene, and changes their paths.
/// Replaces blocks that an earlier one of the scene's cells is the same as by where that stands:
/// {"from":"zpass/seen"}. Files that are not there stay so. Throws Error as ReplacedFolder does.
void share_files(const ReplacedFolder& files, const SceneFiles& scene);

/// A cell's script with all blocks in itself. `script_of`: that of another technique of its scene,
/// empty where there is none; what is not found there stays as it is.
std::string with_own_blocks(const std::string& script,
                            const std::function<std::string(const std::string&)>& script_of);

/// What is wrong with a script whose blocks were to be its own, or empty.
std::string lacking_blocks(std::string_view script);

} // namespace shadowproof
