#include "scenes/gltf_pose.h"

#include <fmt/format.h>

namespace shadowproof::gltf {

void pose_nodes(AccessorReader& reader, double, NodeGraph&, std::vector<std::string>& notes) {
    if (count_of(reader.document().root(), "animations") > 0)
        notes.push_back("animations are not evaluated: rest pose");
}

} // namespace shadowproof::gltf
