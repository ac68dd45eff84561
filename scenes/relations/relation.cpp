#include "scenes/relations/relation.h"

#include "scenes/relations/relation_table.h"

namespace shadowproof {

std::span<const Relation> relations() {
    static const std::vector<Relation> all = [] {
        std::vector<Relation> both = motions();
        const std::vector<Relation> meshes = mesh_changes();
        both.insert(both.end(), meshes.begin(), meshes.end());
        return both;
    }();
    return all;
}

} // namespace shadowproof
