#include "reference/trace/embree.h"

#include "reference/trace/instruction_set.h"
#include "reference/trace/trace.h"
#include "scenes/error.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <span>
#include <type_traits>

namespace shadowproof {

namespace {

struct ReleaseDevice {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseBvh {
    void operator()(RTCBVH bvh) const { rtcReleaseBVH(bvh); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice>;
using Bvh = std::unique_ptr<std::remove_pointer_t<RTCBVH>, ReleaseBvh>;

/// Measured with tests/bench: 4 costs 2 % more, 8 costs 5 %.
constexpr unsigned int branching = 2;

/// A node of Embree's builder: either children or triangles.
struct BuildNode {
    std::array<BuildNode*, branching> children{};
    unsigned int child_count = 0; ///< 0: a leaf
    std::array<std::uint32_t, RTC_BUILD_MAX_PRIMITIVES_PER_LEAF> triangles{};
    unsigned int triangle_count = 0;
};

void* create_node(RTCThreadLocalAllocator allocator, unsigned int, void*) {
    return new (rtcThreadLocalAlloc(allocator, sizeof(BuildNode), alignof(BuildNode))) BuildNode;
}

void set_children(void* node, void** children, unsigned int count, void*) {
    auto& parent = *static_cast<BuildNode*>(node);
    parent.child_count = count;
    for (unsigned int i = 0; i < count; ++i)
        parent.children[i] = static_cast<BuildNode*>(children[i]);
}

/// Bounds are taken from the vertices when the tree is flattened.
void set_bounds(void*, const RTCBounds**, unsigned int, void*) {}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives,
                  std::size_t count, void*) {
    auto* leaf =
        new (rtcThreadLocalAlloc(allocator, sizeof(BuildNode), alignof(BuildNode))) BuildNode;
    leaf->triangle_count = static_cast<unsigned int>(count);
    for (std::size_t i = 0; i < count; ++i) leaf->triangles[i] = primitives[i].primID;
    // The order must not depend on thread count or scheduling.
    std::sort(leaf->triangles.begin(), leaf->triangles.begin() + leaf->triangle_count);
    return leaf;
}

constexpr float infinity = std::numeric_limits<float>::infinity();

void include(Entry& entry, const std::array<float, 3>& lower, const std::array<float, 3>& upper) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        entry.lower[axis] = std::min(entry.lower[axis], lower[axis]);
        entry.upper[axis] = std::max(entry.upper[axis], upper[axis]);
    }
}

Entry empty_entry() {
    Entry entry;
    entry.lower.fill(infinity);
    entry.upper.fill(-infinity);
    return entry;
}

void include(Entry& entry, const Scene& scene, std::uint32_t triangle) {
    for (const glm::uint index :
         {scene.triangles[triangle].x, scene.triangles[triangle].y, scene.triangles[triangle].z}) {
        const glm::vec3& p = scene.positions[index];
        include(entry, {p.x, p.y, p.z}, {p.x, p.y, p.z});
    }
}

class Flattener {
public:
    Flattener(const Scene& scene, Hierarchy& hierarchy) : scene_(scene), hierarchy_(hierarchy) {}

    /// The entry of a node; its children are placed side by side after all entries so far.
    Entry flatten(const BuildNode& node, int level) {
        // Embree guarantees at most 64 levels; a leaf of several clusters adds one.
        if (level >= deepest_level)
            throw Error("Embree", "the hierarchy is deeper than was asked for",
                        "report this with the scene");
        if (node.child_count == 0)
            return leaf(std::span(node.triangles).first(node.triangle_count));
        const std::size_t first = allocate(node.child_count);
        for (std::size_t i = 0; i < node.child_count; ++i)
            hierarchy_.entries[first + i] = flatten(*node.children[i], level + 1);
        return around(first, node.child_count);
    }

private:
    const Scene& scene_;
    Hierarchy& hierarchy_;

    std::size_t allocate(std::size_t count) {
        const std::size_t first = hierarchy_.entries.size();
        hierarchy_.entries.resize(first + count);
        return first;
    }

    Entry around(std::size_t first, std::size_t count) const {
        Entry entry = empty_entry();
        entry.first = static_cast<std::uint32_t>(first);
        entry.count = static_cast<std::uint32_t>(count);
        for (std::size_t i = first; i < first + count; ++i)
            include(entry, hierarchy_.entries[i].lower, hierarchy_.entries[i].upper);
        return entry;
    }

    /// Triangles with one box cannot be split: such a leaf becomes several clusters.
    Entry leaf(std::span<const std::uint32_t> triangles) {
        if (triangles.size() <= cluster_capacity) return cluster(triangles);
        const std::size_t count = (triangles.size() + cluster_capacity - 1) / cluster_capacity;
        const std::size_t first = allocate(count);
        for (std::size_t i = 0; i < count; ++i) {
            const std::span<const std::uint32_t> rest = triangles.subspan(i * cluster_capacity);
            hierarchy_.entries[first + i] =
                cluster(rest.first(std::min<std::size_t>(rest.size(), cluster_capacity)));
        }
        return around(first, count);
    }

    Entry cluster(std::span<const std::uint32_t> triangles) {
        Entry entry = empty_entry();
        entry.first = static_cast<std::uint32_t>(hierarchy_.clusters.size());
        Cluster made;
        made.count = static_cast<std::uint32_t>(triangles.size());
        std::copy(triangles.begin(), triangles.end(), made.triangles.begin());
        hierarchy_.clusters.push_back(made);
        for (const std::uint32_t triangle : triangles) include(entry, scene_, triangle);
        return entry;
    }
};

std::vector<RTCBuildPrimitive> primitives_of(const Scene& scene,
                                             std::span<const std::uint32_t> triangles) {
    std::vector<RTCBuildPrimitive> primitives;
    primitives.reserve(triangles.size());
    for (const std::uint32_t triangle : triangles) {
        Entry box = empty_entry();
        include(box, scene, triangle);
        primitives.push_back({box.lower[0], box.lower[1], box.lower[2], 0, box.upper[0],
                              box.upper[1], box.upper[2], triangle});
    }
    return primitives;
}

} // namespace

Hierarchy build_hierarchy(const Scene& scene, std::span<const std::uint32_t> triangles,
                          int threads) {
    const Device device(
        rtcNewDevice(fmt::format("threads={}{}", threads, embree_instruction_set()).c_str()));
    if (!device)
        throw Error(
            "Embree",
            fmt::format("no device (error {})", static_cast<int>(rtcGetDeviceError(nullptr))),
            "check that the processor has SSE2");
    const Bvh bvh(rtcNewBVH(device.get()));
    std::vector<RTCBuildPrimitive> primitives = primitives_of(scene, triangles);

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
    const auto* root = static_cast<const BuildNode*>(rtcBuildBVH(&arguments));
    if (root == nullptr)
        throw Error("Embree",
                    fmt::format("the hierarchy over {} triangles was not built (error {})",
                                triangles.size(),
                                static_cast<int>(rtcGetDeviceError(device.get()))),
                    "check that there is enough memory");

    Hierarchy hierarchy;
    hierarchy.entries.reserve(triangles.size() / 2 + 1);
    hierarchy.clusters.reserve(triangles.size() / 4 + 1);
    hierarchy.entries.emplace_back();
    Flattener flattener(scene, hierarchy);
    const Entry top = flattener.flatten(*root, 0);
    hierarchy.entries[0] = top;
    return hierarchy;
}

std::string embree_version() {
    const Device device(rtcNewDevice(nullptr));
    const auto part = [&](RTCDeviceProperty property) {
        return static_cast<long>(rtcGetDeviceProperty(device.get(), property));
    };
    return fmt::format("{}.{}.{}", part(RTC_DEVICE_PROPERTY_VERSION_MAJOR),
                       part(RTC_DEVICE_PROPERTY_VERSION_MINOR),
                       part(RTC_DEVICE_PROPERTY_VERSION_PATCH));
}

} // namespace shadowproof
