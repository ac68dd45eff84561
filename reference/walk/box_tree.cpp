#include "reference/walk/box_tree.h"

#include "scenes/error.h"
#include "scenes/roundoff.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <exception>
#include <limits>

namespace shadowproof {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

// By how much Embree misplaces the side of a box, read off Embree 3.13.5 and held to it by
// tests/reference/trace/embree_boxes_test.cpp, with u = 2^-24, on each axis:
//   - it replaces components of d smaller than 1e-18 by that, and its reciprocals are off by up to
//     5.3 u (SSE2, an estimate of 12 bits and a Newton step; less with AVX2 and AVX-512), so that s
//     at which a side is met is off by as much of itself; subtraction and product round twice:
//     together at most 7.4 u s |d|. With s |d| <= 4, from one end of [-2, 2] to the other, 30 u.
//   - where o r is rounded by itself, o moves by u |o|, and b by u |b|: 2 u |o| <= 4 u, as s |d|
//     holds the rest.
// Rounding o to float moves a ray by u |o| <= 2 u, rounding d by s u |d| <= 4 u. In all 40 u.
constexpr double walk_error = 40 * float_roundoff;
// BoxTrees leaves half of a margin to it.
static_assert(walk_error <= 0.5 * BoxTree::smallest_margin);

/// Boxes that every ray meets: rays start within [-2, 2].
constexpr float everywhere = 8;

RTCBounds bounds_in(const WalkFrame& frame, const Box& box, float margin) {
    std::array<float, 3> lower{};
    std::array<float, 3> upper{};
    bool is_outlying = false;
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        const double low = (double{box.lower[axis]} - frame.center[axis]) * frame.scale;
        const double high = (double{box.upper[axis]} - frame.center[axis]) * frame.scale;
        // One float further out covers both roundings.
        lower[i] = std::nextafter(static_cast<float>(low - margin), -infinity);
        upper[i] = std::nextafter(static_cast<float>(high + margin), infinity);
        is_outlying |= !(low >= -1 && high <= 1);
    }
    if (is_outlying) {
        lower.fill(-everywhere);
        upper.fill(everywhere);
    }
    return {lower[0], lower[1], lower[2], 0, upper[0], upper[1], upper[2], 0};
}

/// A walk under way. Embree hands its context to the callbacks.
struct Walk {
    RTCIntersectContext context{}; ///< first, so that callbacks find the rest
    VisitCluster visit = nullptr;
    void* visitor = nullptr;
    int first = 0;               ///< the packet's first lane
    std::exception_ptr thrown{}; ///< by a visit: Embree would take it for its own
};

template <class Arguments, class Rays>
void call_back(const Arguments* at, Rays* rays) {
    auto& walk = *reinterpret_cast<Walk*>(at->context); // NOLINT: is its first member
    float* const far = &RTCRayN_tfar(rays, at->N, 0);
    try {
        if (!walk.thrown)
            walk.visit(walk.visitor, at->primID, walk.first, static_cast<int>(at->N), far);
    } catch (...) {
        walk.thrown = std::current_exception();
    }
    if (walk.thrown) std::fill_n(far, at->N, 0.0F); // nothing further is looked for
}

/// What bounds are asked for of.
struct BoxesToBuild {
    const Clusters* clusters = nullptr;
    WalkFrame frame;
    float margin = 0;
};

/// Whether rays are as walk_error has them; Embree aborts on some that are not, and loses boxes of
/// others.
[[maybe_unused]] bool are_walkable(const WalkRays& rays) {
    for (std::uint32_t left = rays.lanes; left != 0; left &= left - 1) {
        const auto l = static_cast<std::size_t>(__builtin_ctz(left));
        float size = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const float d = rays.way[axis][l];
            size = std::max(size, std::abs(d));
            if (!(std::abs(rays.start[axis][l]) <= 2) || (d < 0 && d > -1e-18F)) return false;
        }
        if (!(size >= 1 && size <= 2) || !(rays.far[l] > 0)) return false;
    }
    return true;
}

int native_width(RTCDevice device) {
    if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0) return 16;
    return rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) != 0 ? 8 : 4;
}

} // namespace

BoxTree::BoxTree(const Clusters& clusters, const WalkFrame& frame, float margin, int threads)
    : device_(make_embree_device(threads)), scene_(rtcNewScene(device_.get())), margin_(margin),
      width_(native_width(device_.get())) {
    BoxesToBuild boxes{&clusters, frame, margin};
    const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned int>(clusters.all.size()));
    rtcSetGeometryUserData(geometry, &boxes);
    rtcSetGeometryBoundsFunction(
        geometry,
        [](const RTCBoundsFunctionArguments* of) {
            const auto& asked = *static_cast<const BoxesToBuild*>(of->geometryUserPtr);
            *of->bounds_o = bounds_in(asked.frame, asked.clusters->boxes[of->primID], asked.margin);
        },
        nullptr);
    rtcSetGeometryIntersectFunction(geometry, [](const RTCIntersectFunctionNArguments* at) {
        call_back(at, RTCRayHitN_RayN(at->rayhit, at->N));
    });
    rtcSetGeometryOccludedFunction(
        geometry, [](const RTCOccludedFunctionNArguments* at) { call_back(at, at->ray); });
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_.get());
    if (const RTCError error = rtcGetDeviceError(device_.get()); error != RTC_ERROR_NONE)
        throw Error("Embree",
                    fmt::format("the tree over {} boxes was not built (error {})",
                                clusters.all.size(), static_cast<int>(error)),
                    "check that there is enough memory");
}

double BoxTree::room() const {
    return margin_ - walk_error;
}

// A coherent packet is walked once for each octant that its rays' directions lie in, and a box may
// be reported each time.
template <BoxTree::Query query>
void BoxTree::walk(const WalkRays& rays, VisitCluster visit, void* visitor) const {
    assert(are_walkable(rays));
    Walk walk;
    rtcInitIntersectContext(&walk.context);
    walk.context.flags = query == Query::all ? RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT
                                             : RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    walk.visit = visit;
    walk.visitor = visitor;
    const auto send = [&]<class Packet>(const Packet* /*type*/, auto intersect, auto occluded) {
        constexpr std::size_t width = std::size(decltype(Packet::ray.tfar){});
        alignas(64) std::array<int, width> valid;
        Packet packet; // NOLINT: what is not set is not read
        const auto first = static_cast<std::size_t>(walk.first);
        const auto set = [&](float* to, const Lanes<float>& from) {
            std::copy_n(from.begin() + first, width, to);
        };
        for (std::size_t i = 0; i < width; ++i)
            valid[i] = -static_cast<int>(rays.lanes >> (first + i) & 1U);
        set(packet.ray.org_x, rays.start[0]);
        set(packet.ray.org_y, rays.start[1]);
        set(packet.ray.org_z, rays.start[2]);
        set(packet.ray.dir_x, rays.way[0]);
        set(packet.ray.dir_y, rays.way[1]);
        set(packet.ray.dir_z, rays.way[2]);
        set(packet.ray.tfar, rays.far);
        std::fill_n(packet.ray.tnear, width, 0.0F);
        std::fill_n(packet.ray.mask, width, 0xffffffffU);
        if constexpr (query == Query::any)
            occluded(valid.data(), scene_.get(), &walk.context, &packet.ray);
        else
            intersect(valid.data(), scene_.get(), &walk.context, &packet);
    };
    for (walk.first = 0; walk.first < packet_size; walk.first += width_) {
        if ((rays.lanes >> walk.first & ((1U << width_) - 1)) == 0) continue;
        if (width_ == 16)
            send(static_cast<const RTCRayHit16*>(nullptr), rtcIntersect16, rtcOccluded16);
        if (width_ == 8) send(static_cast<const RTCRayHit8*>(nullptr), rtcIntersect8, rtcOccluded8);
        if (width_ == 4) send(static_cast<const RTCRayHit4*>(nullptr), rtcIntersect4, rtcOccluded4);
        if (walk.thrown) std::rethrow_exception(walk.thrown);
    }
}

void BoxTree::find_nearest(const WalkRays& rays, VisitCluster visit, void* visitor) const {
    walk<Query::nearest>(rays, visit, visitor);
}
void BoxTree::find_any(const WalkRays& rays, VisitCluster visit, void* visitor) const {
    walk<Query::any>(rays, visit, visitor);
}
void BoxTree::find_all(const WalkRays& rays, VisitCluster visit, void* visitor) const {
    walk<Query::all>(rays, visit, visitor);
}

} // namespace shadowproof
