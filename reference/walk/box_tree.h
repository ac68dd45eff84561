// Embree's walk: a tree over the clusters' boxes, as user geometry, and packets of rays through it.
// Embree walks in float and is trusted to reach every box that a ray meets, as boxes are enlarged
// by more than its rounding can take. What is in a box is decided by whoever is called back.
#pragma once

#include "reference/walk/clusters.h"
#include "reference/walk/embree_device.h"

#include <array>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

namespace shadowproof {

/// The most rays in a packet.
inline constexpr int packet_size = 16;

template <class T>
using Lanes = std::array<T, packet_size>;

/// A vector for each ray, components apart, so that vector instructions take many rays at once.
struct Vectors {
    alignas(64) std::array<Lanes<double>, 3> axis{};

    glm::dvec3 operator[](std::size_t lane) const {
        return {axis[0][lane], axis[1][lane], axis[2][lane]};
    }
    void set(std::size_t lane, const glm::dvec3& v) {
        for (std::size_t i = 0; i < 3; ++i) axis[i][lane] = v[static_cast<int>(i)];
    }
};

/// Coordinates in which the walk is done: (p - center) scale, scale a power of two. The scene's box
/// lies within [-1, 1], but for a few triangles very far out, whose boxes every ray meets.
struct WalkFrame {
    glm::dvec3 center{0, 0, 0};
    double scale = 1;
};

/// What the walk needs of rays o + s d: |o| <= 2, 1 <= |d| < 2 in the largest component, none
/// between -1e-18 and 0, 0 < far.
struct WalkRays {
    alignas(64) std::array<Lanes<float>, 3> start{};
    alignas(64) std::array<Lanes<float>, 3> way{};
    alignas(64) Lanes<float> far{};
    std::uint32_t lanes = 0; ///< one bit per ray
};

/// Called for each cluster whose box some ray may meet, with the packet's lanes [first, first +
/// count). `far` holds their limits: it may lower one, but keeps it above 0; where any meeting is
/// searched for, minus infinity ends that ray's search.
using VisitCluster = void (*)(void* visitor, std::uint32_t cluster, int first, int count,
                              float* far);

class BoxTree {
public:
    /// Boxes are enlarged by `margin` on every side, which must be smallest_margin at the least.
    /// threads 0: one per core. Throws Error.
    BoxTree(const Clusters& clusters, const WalkFrame& frame, float margin, int threads);

    /// Each reaches every cluster whose box a ray's true line, anywhere within `room` of the given
    /// one, meets before its limit. Those of rays that run side by side are reached sooner, though
    /// perhaps more than once.
    void find_nearest(const WalkRays& rays, VisitCluster visit, void* visitor) const;
    /// Until the limit is minus infinity.
    void find_any(const WalkRays& rays, VisitCluster visit, void* visitor) const;
    /// Each cluster once.
    void find_all(const WalkRays& rays, VisitCluster visit, void* visitor) const;

    float margin() const { return margin_; }
    /// How far a ray's true line may be from o + s d, where that is given in double and rounded to
    /// floats.
    double room() const;

    static constexpr float smallest_margin = 0x1p-17F;

private:
    struct ReleaseScene {
        void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    };
    EmbreeDevice device_;
    std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene> scene_;
    float margin_;
    int width_ = 4; ///< of the packets that Embree walks natively with this instruction set

    enum class Query : std::uint8_t { nearest, any, all };
    template <Query query>
    void walk(const WalkRays& rays, VisitCluster visit, void* visitor) const;
};

} // namespace shadowproof
