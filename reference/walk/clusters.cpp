#include "reference/walk/clusters.h"

#include "reference/walk/embree_device.h"
#include "scenes/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <limits>
#include <memory>
#include <type_traits>
#include <utility>

namespace shadowproof {

namespace {

struct ReleaseBvh {
    void operator()(RTCBVH bvh) const { rtcReleaseBVH(bvh); }
};
using Bvh = std::unique_ptr<std::remove_pointer_t<RTCBVH>, ReleaseBvh>;

constexpr unsigned int branching = 2;

/// A node of Embree's builder.
struct Node {
    std::array<Node*, branching> children{}; ///< null where there is none
};
struct Leaf : Node {
    std::size_t count = 0;

    /// They lie behind the leaf itself: most leaves have far fewer than the most that are possible.
    std::span<std::uint32_t> triangles() {
        return {reinterpret_cast<std::uint32_t*>(this + 1), count}; // NOLINT: allocated with it
    }
};

void* create_node(RTCThreadLocalAllocator allocator, unsigned int, void*) {
    return new (rtcThreadLocalAlloc(allocator, sizeof(Node), alignof(Node))) Node;
}

void set_children(void* node, void** children, unsigned int count, void*) {
    for (unsigned int i = 0; i < count; ++i)
        static_cast<Node*>(node)->children[i] = static_cast<Node*>(children[i]);
}

/// Bounds are taken from the vertices.
void set_bounds(void*, const RTCBounds**, unsigned int, void*) {}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives,
                  std::size_t count, void*) {
    const std::size_t size = sizeof(Leaf) + count * sizeof(std::uint32_t);
    auto* leaf = new (rtcThreadLocalAlloc(allocator, size, alignof(Leaf))) Leaf;
    leaf->count = count;
    const std::span<std::uint32_t> triangles = leaf->triangles();
    for (std::size_t i = 0; i < count; ++i) triangles[i] = primitives[i].primID;
    // The order must not depend on thread count or scheduling.
    std::ranges::sort(triangles);
    return static_cast<Node*>(leaf);
}

Box empty_box() {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    return {glm::vec3(infinity), glm::vec3(-infinity)};
}

void include(Box& box, const Box& other) {
    box.lower = glm::min(box.lower, other.lower);
    box.upper = glm::max(box.upper, other.upper);
}

Box box_of(const Scene& scene, std::uint32_t triangle) {
    Box box = empty_box();
    for (int k = 0; k < 3; ++k) {
        const glm::vec3& p = scene.positions[scene.triangles[triangle][k]];
        include(box, {p, p});
    }
    return box;
}

void add_cluster(const Scene& scene, std::span<const std::uint32_t> triangles, Clusters& clusters) {
    Cluster& made = clusters.all.emplace_back();
    made.triangles.fill(no_triangle);
    Box box = empty_box();
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        made.triangles[i] = triangles[i];
        for (int k = 0; k < 3; ++k)
            for (int axis = 0; axis < 3; ++axis)
                made.corner[static_cast<std::size_t>(k)][static_cast<std::size_t>(axis)][i] =
                    scene.positions[scene.triangles[triangles[i]][k]][axis];
        include(box, box_of(scene, triangles[i]));
    }
    clusters.boxes.push_back(box);
    include(clusters.box, box);
}

/// A leaf of triangles with one box, which cannot be split, becomes several clusters.
void add_leaf(const Scene& scene, Leaf& leaf, Clusters& clusters) {
    std::span<const std::uint32_t> rest = leaf.triangles();
    while (!rest.empty()) {
        const std::size_t count = std::min<std::size_t>(rest.size(), cluster_capacity);
        add_cluster(scene, rest.first(count), clusters);
        rest = rest.subspan(count);
    }
}

/// Depth first, so that neighbours lie side by side. Embree's tree has at most 64 levels.
void add_node(const Scene& scene, Node& node, Clusters& clusters) {
    if (node.children[0] == nullptr) {
        add_leaf(scene, static_cast<Leaf&>(node), clusters);
        return;
    }
    for (Node* child : node.children)
        if (child != nullptr) add_node(scene, *child, clusters);
}

void make_groups(Clusters& clusters) {
    const std::vector<Box>* below = &clusters.boxes;
    while (below->size() >= Clusters::group_size) {
        std::vector<Box> level((below->size() + Clusters::group_size - 1) / Clusters::group_size,
                               empty_box());
        for (std::size_t i = 0; i < below->size(); ++i)
            include(level[i / Clusters::group_size], (*below)[i]);
        clusters.groups.push_back(std::move(level));
        below = &clusters.groups.back();
    }
}

} // namespace

Clusters build_clusters(const Scene& scene, std::span<const std::uint32_t> triangles,
                        std::span<const std::uint32_t> planes, int threads) {
    const EmbreeDevice device = make_embree_device(threads);
    const Bvh bvh(rtcNewBVH(device.get()));
    std::vector<RTCBuildPrimitive> primitives;
    primitives.reserve(triangles.size());
    for (const std::uint32_t triangle : triangles) {
        const Box box = box_of(scene, triangle);
        primitives.push_back({box.lower.x, box.lower.y, box.lower.z, 0, box.upper.x, box.upper.y,
                              box.upper.z, triangle});
    }

    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.maxBranchingFactor = branching;
    arguments.maxDepth = 64;
    arguments.sahBlockSize = cluster_capacity;
    arguments.maxLeafSize = cluster_capacity;
    arguments.bvh = bvh.get();
    arguments.primitives = primitives.data();
    arguments.primitiveCount = primitives.size();
    arguments.primitiveArrayCapacity = primitives.size();
    arguments.createNode = create_node;
    arguments.setNodeChildren = set_children;
    arguments.setNodeBounds = set_bounds;
    arguments.createLeaf = create_leaf;
    auto* root = static_cast<Node*>(rtcBuildBVH(&arguments));
    if (root == nullptr)
        throw Error("Embree",
                    fmt::format("{} triangles were not grouped (error {})", triangles.size(),
                                static_cast<int>(rtcGetDeviceError(device.get()))),
                    "check that there is enough memory");
    std::vector<RTCBuildPrimitive>().swap(primitives);

    Clusters clusters;
    clusters.box = empty_box();
    clusters.all.reserve(triangles.size() / 4 + 1);
    clusters.boxes.reserve(triangles.size() / 4 + 1);
    add_node(scene, *root, clusters);
    for (Cluster& cluster : clusters.all)
        for (std::size_t i = 0; i < cluster_capacity; ++i)
            if (cluster.triangles[i] != no_triangle)
                cluster.planes[i] = planes[cluster.triangles[i]];
    make_groups(clusters);
    return clusters;
}

} // namespace shadowproof
