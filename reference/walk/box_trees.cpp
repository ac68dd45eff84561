#include "reference/walk/box_trees.h"

#include "reference/walk/reach.h"

#include <cmath>

namespace shadowproof {

namespace {

WalkFrame frame_of(const Clusters& clusters) {
    WalkFrame frame;
    frame.center = center_of_most(clusters);
    const double reach = reach_of_most(clusters, frame.center);
    frame.scale = reach > 0 ? std::exp2(-std::ilogb(reach) - 1) : 1;
    return frame;
}

} // namespace

BoxTrees::BoxTrees(const Clusters& clusters, int threads)
    : clusters_(&clusters), frame_(frame_of(clusters)), threads_(threads) {
    tree(0);
}

const BoxTree& BoxTrees::tree(std::size_t i) const {
    Tree& found = trees_[i];
    std::call_once(found.built, [&] {
        const float margin = std::ldexp(BoxTree::smallest_margin, 5 * static_cast<int>(i));
        found.tree = std::make_unique<BoxTree>(*clusters_, frame_, margin, threads_);
    });
    return *found.tree;
}

const BoxTree* BoxTrees::with_room(double room) const {
    for (std::size_t i = 0; i < trees_.size(); ++i)
        // Half of each margin is more than Embree's own rounding takes.
        if (room <= std::ldexp(double{BoxTree::smallest_margin}, 5 * static_cast<int>(i) - 1))
            return &tree(i);
    return nullptr;
}

} // namespace shadowproof
