#include "scenes/relations/relation.h"

#include "scenes/relations/retellings.h"

namespace shadowproof {

std::span<const Relation> relations() {
    static const std::vector<Relation> all = [] {
        std::vector<Relation> both = motions();
        const std::vector<Relation> meshes = retold_meshes();
        both.insert(both.end(), meshes.begin(), meshes.end());
        return both;
    }();
    return all;
}

} // namespace shadowproof
