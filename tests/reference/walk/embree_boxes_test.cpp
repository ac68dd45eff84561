// What Embree promises of boxes, and what it does not. It walks its tree in float, so a box of user
// geometry that a ray meets is certain to be visited only where the box is enlarged by a bound.
//
// Derived for Embree 3.13.5, u = 2^-24. A ray o + s d, tnear = +0, tfar > s, meets a box; on each
// axis, with |d| between 1 and 2 in the largest component and s <= 1:
//   - d is replaced by 1e-18 where it is smaller (rcp_safe): the ray moves by less than 2^-58;
//   - r = 1 / d is an estimate and a Newton step: off by 1.07 u (AVX-512), 3.3 u (AVX2), 5.3 u
//     (SSE2, whose estimate of 12 bits leaves 2.3 u, and three roundings);
//   - with fused products a side at b is met at fl(b r - fl(o r)): one rounding, and o moved by
//     u |o|. Without, at fl(fl(b - o) r), two roundings; but the coherent flag first tests all
//     lanes of an octant together, by fl(fl(b r) - fl(o r)): one rounding, u |o| and u |b|, where
//     |b| is |o| + s |d|. There o is the largest of the packet.
// So a side is misplaced by at most c u |o| + k u s |d|, with c = 1 and k = 2.1 (AVX-512) and 4.4
// (AVX2), or c = 2 and k = 7.4 (SSE2), and boxes enlarged by that are not lost. What is compared is
// min and max of such numbers, unrounded.
#include "scenes/roundoff.h"

#include <embree3/rtcore.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

namespace shadowproof {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float least_component = 1e-18F; ///< of directions, to Embree
constexpr std::size_t most_lanes = 16;

struct InstructionSet {
    std::string name;
    std::size_t width; ///< of its native packets
    RTCDeviceProperty native;
    double share;        ///< k above
    double origin_share; ///< c above
};
std::ostream& operator<<(std::ostream& out, const InstructionSet& set) {
    return out << set.name;
}

struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release>;
using World = std::unique_ptr<std::remove_pointer_t<RTCScene>, Release>;

/// Null where this processor has not got the instruction set.
Device device_for(const InstructionSet& set) {
    Device device(rtcNewDevice(("threads=1,isa=" + set.name).c_str()));
    if (device && rtcGetDeviceProperty(device.get(), set.native) == 0) device.reset();
    return device;
}

using Box = std::array<std::array<float, 2>, 3>; ///< lower and upper, by axis

struct Ray {
    std::array<float, 3> origin{};
    std::array<float, 3> direction{};
    float far = infinity;
};
using Rays = std::array<Ray, most_lanes>;

/// Which boxes Embree visits for which lane: bits of boxes' entries.
struct Visits {
    RTCIntersectContext context{}; ///< first, so that callbacks find the rest
    std::vector<std::uint32_t> lanes;
};

void visit(RTCIntersectContext* context, unsigned int box, const int* valid, unsigned int width) {
    std::uint32_t& lanes = reinterpret_cast<Visits*>(context)->lanes[box]; // NOLINT: is its first
    for (unsigned int lane = 0; lane < width; ++lane)
        if (valid[lane] != 0) lanes |= 1U << lane;
}

/// Embree's scene of some boxes, which may be changed and built again.
class Boxes {
public:
    Boxes(RTCDevice device, std::size_t count) : boxes(count), world_(rtcNewScene(device)) {
        geometry_ = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
        rtcSetGeometryUserPrimitiveCount(geometry_, static_cast<unsigned int>(count));
        rtcSetGeometryUserData(geometry_, this);
        rtcSetGeometryBoundsFunction(
            geometry_,
            [](const RTCBoundsFunctionArguments* of) {
                const Box& box = static_cast<Boxes*>(of->geometryUserPtr)->boxes[of->primID];
                *of->bounds_o = {box[0][0], box[1][0], box[2][0], 0,
                                 box[0][1], box[1][1], box[2][1], 0};
            },
            nullptr);
        rtcSetGeometryIntersectFunction(geometry_, [](const RTCIntersectFunctionNArguments* at) {
            visit(at->context, at->primID, at->valid, at->N);
        });
        rtcSetGeometryOccludedFunction(geometry_, [](const RTCOccludedFunctionNArguments* at) {
            visit(at->context, at->primID, at->valid, at->N);
        });
        rtcAttachGeometry(world_.get(), geometry_);
        rtcReleaseGeometry(geometry_);
    }

    std::vector<Box> boxes;

    void build() {
        rtcCommitGeometry(geometry_);
        rtcCommitScene(world_.get());
    }
    RTCScene world() const { return world_.get(); }

private:
    World world_;
    RTCGeometry geometry_ = nullptr; ///< the scene's
};

template <class Packet>
void set(Packet& packet, const Rays& rays, std::size_t width) {
    for (std::size_t i = 0; i < width; ++i) {
        packet.org_x[i] = rays[i].origin[0];
        packet.org_y[i] = rays[i].origin[1];
        packet.org_z[i] = rays[i].origin[2];
        packet.dir_x[i] = rays[i].direction[0];
        packet.dir_y[i] = rays[i].direction[1];
        packet.dir_z[i] = rays[i].direction[2];
        packet.tfar[i] = rays[i].far;
        packet.mask[i] = 0xffffffffU;
    }
}

/// Sends the first `width` rays through the scene by a native packet; returns a bit for each lane
/// that met something.
std::uint32_t shoot(RTCScene world, RTCIntersectContext& context, const Rays& rays,
                    std::size_t width, bool nearest) {
    alignas(64) std::array<int, most_lanes> valid{};
    valid.fill(-1);
    std::uint32_t met = 0;
    const auto send = [&](auto&& packet, auto intersect, auto occluded) {
        set(packet.ray, rays, width);
        for (unsigned int& id : packet.hit.geomID) id = RTC_INVALID_GEOMETRY_ID;
        if (nearest) {
            intersect(valid.data(), world, &context, &packet);
        } else {
            occluded(valid.data(), world, &context, &packet.ray);
        }
        for (std::size_t i = 0; i < width; ++i)
            if (nearest ? packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID : packet.ray.tfar[i] < 0)
                met |= 1U << i;
    };
    if (width == 16) send(RTCRayHit16{}, rtcIntersect16, rtcOccluded16);
    if (width == 8) send(RTCRayHit8{}, rtcIntersect8, rtcOccluded8);
    if (width == 4) send(RTCRayHit4{}, rtcIntersect4, rtcOccluded4);
    return met;
}

RTCIntersectContext context_with(bool coherent) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags =
        coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    return context;
}

class EmbreeBoxes : public testing::TestWithParam<InstructionSet> {
protected:
    Device device_ = device_for(GetParam());

    void SetUp() override {
        if (!device_) GTEST_SKIP() << "this processor has no " << GetParam().name;
    }
};

// ---------------------------------------------------------------------------- enlarged boxes

/// Rays from the cube of side 2 about 0, and boxes that they touch at a corner, an edge or a face.
class Adversary {
public:
    Adversary(std::uint32_t seed, const InstructionSet& set) : random_(seed), set_(set) {}

    Ray ray(bool one_octant) {
        Ray ray;
        float size = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            ray.origin[axis] = static_cast<float>(2 * unit() - 1);
            float d = component();
            // One octant: then all lanes of a packet are tested together.
            ray.direction[axis] = d = one_octant ? std::abs(d) : d;
            size = std::max(size, std::abs(d));
        }
        if (size < 1) ray.direction[random_() % 3] = size = 1 + static_cast<float>(unit());
        for (float& d : ray.direction)
            if (d < 0 && d > -least_component) d = 0;
        return ray;
    }

    /// A box that the ray touches from outside, or holds: enlarged by the bound, rounded outwards.
    /// Lengthens `reach` beyond the place. `farthest`: the packet's largest |o|.
    Box touched(const Ray& ray, const std::array<float, 3>& farthest, float& reach) {
        double s = unit();
        for (std::size_t axis = 0; axis < 3; ++axis) { // stays within the cube
            const double d = ray.direction[axis];
            if (d != 0) s = std::min(s, ((d > 0 ? 1 : -1) - ray.origin[axis]) / d);
        }
        Box box;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const long double at =
                ray.origin[axis] + static_cast<long double>(s) * ray.direction[axis];
            const double enlargement =
                float_roundoff * (set_.origin_share * farthest[axis] +
                                  set_.share * s * std::abs(ray.direction[axis])) +
                0x1p-58;
            const double size = random_() % 4 == 0 ? 0 : std::exp2(-30 * unit());
            const bool below = random_() % 2 == 0;
            const bool above = !below || random_() % 4 == 0;
            box[axis] = {rounded(at - enlargement - (below ? size : 0), -infinity),
                         rounded(at + enlargement + (above ? size : 0), infinity)};
        }
        reach = std::max(reach, std::nextafter(static_cast<float>(s), infinity));
        return box;
    }

    bool coin() { return random_() % 2 == 0; }

private:
    std::minstd_rand random_;
    InstructionSet set_;

    double unit() { return static_cast<double>(random_()) / 2147483647.0; }

    /// Of any size; many around the least that is not taken for 0, and zeros of both signs.
    float component() {
        const float sign = coin() ? 1.0F : -1.0F;
        switch (random_() % 8) {
        case 0:
            return sign * 0.0F;
        case 1:
            return sign * least_component * static_cast<float>(0.5 + unit());
        case 2:
            return sign * static_cast<float>(std::exp2(-149 * unit()));
        case 3:
            return sign * static_cast<float>(std::exp2(-30 * unit()));
        default:
            return sign * static_cast<float>(2 * unit() * (1 - 0x1p-20));
        }
    }

    static float rounded(long double x, float towards) {
        const auto near = static_cast<float>(x);
        const bool inside = towards > 0 ? near < x : near > x;
        return inside ? std::nextafter(near, towards) : near;
    }
};

/// How many pairs of a ray and a box that it touches were lost, of `pairs`.
std::uint64_t lost_of(std::uint64_t pairs, RTCDevice device, const InstructionSet& set) {
    constexpr std::size_t per_lane = 16;
    constexpr std::uint32_t seed = 14;
    Adversary adversary(seed, set);
    Boxes boxes(device, per_lane * set.width);
    Visits visits;
    std::uint64_t lost = 0;
    for (std::uint64_t done = 0; done < pairs; done += 4 * boxes.boxes.size()) {
        const bool one_octant = adversary.coin();
        Rays rays;
        std::array<float, 3> farthest{};
        for (std::size_t lane = 0; lane < set.width; ++lane) {
            rays[lane] = adversary.ray(one_octant);
            for (std::size_t axis = 0; axis < 3; ++axis)
                farthest[axis] = std::max(farthest[axis], std::abs(rays[lane].origin[axis]));
        }
        for (std::size_t lane = 0; lane < set.width; ++lane) {
            float reach = 0;
            for (std::size_t i = 0; i < per_lane; ++i)
                boxes.boxes[lane * per_lane + i] = adversary.touched(rays[lane], farthest, reach);
            if (adversary.coin()) rays[lane].far = reach;
        }
        boxes.build();
        for (const bool coherent : {true, false})
            for (const bool nearest : {true, false}) {
                visits.context = context_with(coherent);
                visits.lanes.assign(boxes.boxes.size(), 0);
                shoot(boxes.world(), visits.context, rays, set.width, nearest);
                for (std::size_t i = 0; i < visits.lanes.size(); ++i)
                    lost += (visits.lanes[i] >> (i / per_lane) & 1U) == 0 ? 1 : 0;
            }
    }
    return lost;
}

TEST_P(EmbreeBoxes, boxes_enlarged_by_the_bound_are_never_lost) {
    EXPECT_EQ(lost_of(1'000'000, device_.get(), GetParam()), 0U);
}

TEST_P(EmbreeBoxes, millions_of_boxes_enlarged_by_the_bound_are_not_lost) {
    EXPECT_EQ(lost_of(200'000'000, device_.get(), GetParam()), 0U);
}

TEST_P(EmbreeBoxes, boxes_enlarged_by_less_than_half_of_it_are_lost) {
    InstructionSet less = GetParam();
    less.share *= 0.45;
    less.origin_share *= 0.45;
    EXPECT_GT(lost_of(1'000'000, device_.get(), less), 100U);
}

// ------------------------------------------------------------------- almost zero, and negative

// The smallest case of a known error: with the coherent flag, lanes are put into octants by the
// sign of their directions' components, and a component between -1e-18 and 0 is then replaced by
// +1e-18. The octant's bounds of 1/d are chosen by the sign of the least of them alone, and all
// boxes astride the plane through the origin are lost for all its lanes.
constexpr float almost_zero = -9e-19F;

/// Rays that go down a little, the first of them by `first`.
Rays falling_rays(float first) {
    Rays rays;
    for (std::size_t i = 0; i < most_lanes; ++i)
        rays[i].direction = {0.25F + 0.03F * static_cast<float>(i), -1e-3F, -1};
    rays[0].direction[1] = first;
    return rays;
}

/// A row of strips that stand across the plane y = 0, before the rays.
constexpr int strip_count = 64;
Box strip(int i) {
    const float left = -1 + 2 * static_cast<float>(i) / strip_count;
    return {{{left, left + 2.0F / strip_count}, {-1, 1}, {-1, -1}}};
}

TEST_P(EmbreeBoxes, coherent_packets_with_one_component_of_almost_minus_zero_lose_boxes) {
    const std::size_t width = GetParam().width;
    Boxes strips(device_.get(), strip_count);
    for (int i = 0; i < strip_count; ++i) strips.boxes[static_cast<std::size_t>(i)] = strip(i);
    strips.build();
    const auto lanes_that_visit = [&](float first, bool coherent, bool nearest) {
        Visits visits{context_with(coherent), std::vector<std::uint32_t>(strip_count)};
        shoot(strips.world(), visits.context, falling_rays(first), width, nearest);
        std::uint32_t lanes = 0;
        for (const std::uint32_t each : visits.lanes) lanes |= each;
        return lanes;
    };
    const std::uint32_t all = (1U << width) - 1;
    for (const bool nearest : {true, false}) {
        EXPECT_EQ(lanes_that_visit(almost_zero, true, nearest), 0U);
        EXPECT_EQ(lanes_that_visit(almost_zero, false, nearest), all);
        for (const float cured : {0.0F, -0.0F, -least_component})
            EXPECT_EQ(lanes_that_visit(cured, true, nearest), all) << cured;
    }
}

TEST_P(EmbreeBoxes, so_do_those_that_look_for_ordinary_triangles) {
    const World world(rtcNewScene(device_.get()));
    const RTCGeometry mesh = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const corners = static_cast<float*>(
        rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), std::size_t{4} * strip_count));
    auto* const indices = static_cast<unsigned int*>(
        rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(unsigned int), std::size_t{2} * strip_count));
    for (int i = 0; i < strip_count; ++i) {
        const Box box = strip(i);
        const std::array<float, 12> quad{box[0][0], -1, -1, box[0][1], -1, -1,
                                         box[0][1], 1,  -1, box[0][0], 1,  -1};
        std::copy(quad.begin(), quad.end(), corners + std::ptrdiff_t{12} * i);
        const auto first = static_cast<unsigned int>(4 * i);
        const std::array<unsigned int, 6> two{first, first + 1, first + 2,
                                              first, first + 2, first + 3};
        std::copy(two.begin(), two.end(), indices + std::ptrdiff_t{6} * i);
    }
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(world.get(), mesh);
    rtcReleaseGeometry(mesh);
    rtcSetSceneFlags(world.get(), RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(world.get());
    const std::size_t width = GetParam().width;
    const std::uint32_t all = (1U << width) - 1;
    const auto occluded = [&](float first, bool coherent) {
        RTCIntersectContext context = context_with(coherent);
        return shoot(world.get(), context, falling_rays(first), width, false);
    };
    EXPECT_EQ(occluded(almost_zero, true), 0U);
    EXPECT_EQ(occluded(almost_zero, false), all);
    EXPECT_EQ(occluded(0, true), all);
}

INSTANTIATE_TEST_SUITE_P(
    Reference, EmbreeBoxes,
    testing::Values(InstructionSet{"sse2", 4, RTC_DEVICE_PROPERTY_NATIVE_RAY4_SUPPORTED, 7.4, 2},
                    InstructionSet{"avx2", 8, RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED, 4.4, 1},
                    InstructionSet{"avx512", 16, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED, 2.1,
                                   1}),
    [](const auto& set) { return set.param.name; });

} // namespace
} // namespace shadowproof
