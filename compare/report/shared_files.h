// Writes once what several cells of a scene have alike: techniques that make the same volumes have
// the same pictures, and many of the same blocks.
#pragma once

#include "compare/output/manifest.h"

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace shadowproof {

/// What was written of a scene's cells so far. Another scene's files, which lie in another folder,
/// begin anew.
class SharedFiles {
public:
    /// Where a picture stands: at `path`, "spot/zpass.claim.png", unless an earlier one of its
    /// scene is the same.
    std::string place_of(const std::string& path, std::string_view bytes);
    /// The script at `path`, "spot/zpass.cell.js", with each block that an earlier one of its scene
    /// has replaced by where that stands: {"from":"zpass/seen"}.
    std::string shared(const std::string& path, const std::string& script);

private:
    using Places = std::map<std::pair<std::uint64_t, std::string>, std::string>; // by fingerprint

    std::string folder_;
    Places pictures_;
    Places blocks_;

    void enter_folder_of(const std::string& path);
};

/// A cell's script with all blocks in itself. `script_of`: that of another technique of its scene,
/// empty where there is none; what is not found there stays as it is.
std::string with_own_blocks(const std::string& script,
                            const std::function<std::string(const std::string&)>& script_of);

/// What is wrong with a script whose blocks were to be its own, or empty.
std::string lacking_blocks(std::string_view script);

} // namespace shadowproof
