// Trees over the same boxes, enlarged by more and more, each built when it is first needed: most
// rays are known well enough for the first.
#pragma once

#include "reference/walk/box_tree.h"

#include <array>
#include <memory>
#include <mutex>

namespace shadowproof {

class BoxTrees {
public:
    /// Keeps a reference to the clusters. Chooses the frame; builds the first tree. Throws Error.
    BoxTrees(const Clusters& clusters, int threads);

    const WalkFrame& frame() const { return frame_; }
    const Clusters& clusters() const { return *clusters_; }

    /// A tree with so much room for a ray's true line, in the frame's coordinates; null where that
    /// is no less than all of the scene, so that any ray may meet anything. In any thread.
    const BoxTree* with_room(double room) const;

private:
    struct Tree {
        std::once_flag built;
        std::unique_ptr<BoxTree> tree;
    };
    const Clusters* clusters_;
    WalkFrame frame_;
    int threads_;
    /// Each with 32 times the margin of the one before.
    mutable std::array<Tree, 4> trees_;

    const BoxTree& tree(std::size_t i) const;
};

} // namespace shadowproof
