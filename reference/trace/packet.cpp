#include "reference/trace/packet.h"

#include "reference/trace/rays.h"

#include <algorithm>
#include <cmath>

// Highway compiles what follows once for each instruction set, then chooses when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reference/trace/packet.cpp"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace shadowproof::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::CappedTag<float, packet_size>;
using Ids = hn::RebindToUnsigned<Floats>;
using Vector = hn::Vec<Floats>;
using Mask = hn::Mask<Floats>;

enum class Query : std::uint8_t { nearest, any, lowest, count };

constexpr Floats floats;
constexpr Ids ids;

int step() {
    return static_cast<int>(hn::Lanes(floats));
}

std::uint32_t bits_of(Mask mask, int first_lane) {
    alignas(8) std::array<std::uint8_t, 8> bytes{};
    hn::StoreMaskBits(floats, mask, bytes.data());
    return (static_cast<std::uint32_t>(bytes[0]) | (static_cast<std::uint32_t>(bytes[1]) << 8U))
           << static_cast<unsigned>(first_lane);
}

Mask mask_of(std::uint32_t lanes, int first_lane) {
    const std::uint32_t here = lanes >> static_cast<unsigned>(first_lane);
    alignas(8) const std::array<std::uint8_t, 8> bytes{static_cast<std::uint8_t>(here),
                                                       static_cast<std::uint8_t>(here >> 8U)};
    return hn::LoadMaskBits(floats, bytes.data());
}

Vector load(const Lanes<float>& values, int i) {
    return hn::Load(floats, values.data() + i);
}

/// What floats tell of one triangle for some lanes. Neither certain: undecided.
struct Answer {
    Mask met;
    Mask undecided;
    Vector lo; ///< 1/s lies in [lo, hi]
    Vector hi;
};

/// w . n for one triangle's n of a cluster.
Vector dot(const RayPacket& packet, int i, const std::array<PerTriangle<float>, 3>& n,
           std::size_t triangle) {
    return hn::Add(hn::Add(hn::Mul(load(packet.w[0], i), hn::Set(floats, n[0][triangle])),
                           hn::Mul(load(packet.w[1], i), hn::Set(floats, n[1][triangle]))),
                   hn::Mul(load(packet.w[2], i), hn::Set(floats, n[2][triangle])));
}

/// Comparisons with NaN are false, so whatever overflows is undecided. What is certain does not
/// depend on what was found before.
template <Query query>
Answer test(const RayPacket& packet, int i, std::uint32_t lanes, const ClusterRecord& cluster,
            std::size_t t) {
    const Vector magnitude = load(packet.magnitude, i);
    const Vector inner =
        hn::Min(hn::Min(dot(packet, i, cluster.edge[0], t), dot(packet, i, cluster.edge[1], t)),
                dot(packet, i, cluster.edge[2], t));
    Answer answer;
    const Mask maybe_inside =
        hn::AndNot(hn::Lt(inner, hn::Neg(magnitude)), mask_of(packet.active & lanes, i));
    if (hn::AllFalse(floats, maybe_inside)) {
        answer.met = answer.undecided = maybe_inside;
        answer.lo = answer.hi = inner;
        return answer;
    }
    const Vector tolerance = hn::Mul(magnitude, hn::Set(floats, cluster.inverse_tolerance[t]));
    const Vector inverse = dot(packet, i, cluster.inverse, t);
    answer.lo = hn::Sub(inverse, tolerance);
    answer.hi = hn::Add(inverse, tolerance);
    Mask out = hn::Or(hn::Lt(answer.hi, load(packet.lower_lo, i)),
                      hn::Gt(answer.lo, load(packet.upper_hi, i)));
    if constexpr (query == Query::nearest)
        out = hn::Or(out, hn::Lt(answer.hi, load(packet.best_lo, i)));
    else
        out = hn::Or(out, hn::RebindMask(floats, hn::Eq(hn::Load(ids, packet.skip.data() + i),
                                                        hn::Set(ids, cluster.plane[t]))));
    const Mask candidate = hn::AndNot(out, maybe_inside);
    answer.met = hn::And(hn::And(candidate, hn::Ge(inner, magnitude)),
                         hn::And(hn::Gt(answer.lo, load(packet.lower_hi, i)),
                                 hn::Lt(answer.hi, load(packet.upper_lo, i))));
    answer.undecided = hn::AndNot(answer.met, candidate);
    return answer;
}

/// Keeps what is nearer than the hit for certain; where that is not certain, the arbiter compares.
void keep_nearest(RayPacket& packet, int i, const Answer& answer, std::uint32_t triangle,
                  Arbiter& arbiter) {
    const Mask nearer = hn::And(answer.met, hn::Gt(answer.lo, load(packet.hit_hi, i)));
    hn::BlendedStore(answer.hi, nearer, floats, packet.hit_hi.data() + i);
    hn::BlendedStore(hn::Set(ids, triangle), hn::RebindMask(ids, nearer), ids,
                     packet.hit.data() + i);
    hn::BlendedStore(hn::Max(answer.lo, load(packet.best_lo, i)), answer.met, floats,
                     packet.best_lo.data() + i);
    packet.best_raised = true;
    // A cluster may be found again, and with it the hit.
    const Mask is_hit = hn::RebindMask(
        floats, hn::Eq(hn::Load(ids, packet.hit.data() + i), hn::Set(ids, triangle)));
    const Mask rivals = hn::AndNot(is_hit, answer.met);
    if (hn::AllFalse(floats, rivals)) return;
    alignas(64) Lanes<float> lo{};
    alignas(64) Lanes<float> hi{};
    hn::Store(answer.lo, floats, lo.data());
    hn::Store(answer.hi, floats, hi.data());
    for (std::uint32_t left = bits_of(rivals, 0); left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        const auto l = static_cast<std::size_t>(lane);
        arbiter.compare(packet, i + lane, triangle, lo[l], hi[l]);
    }
}

template <Query query>
void keep(RayPacket& packet, std::uint32_t lanes, std::uint32_t triangle, std::uint32_t copies) {
    for (; lanes != 0; lanes &= lanes - 1) {
        const auto l = static_cast<std::size_t>(__builtin_ctz(lanes));
        if constexpr (query == Query::count) packet.crossed[l] += copies;
        if constexpr (query == Query::any || query == Query::lowest)
            packet.hit[l] = std::min(packet.hit[l], triangle);
        if constexpr (query == Query::any) packet.active &= ~(1U << l);
    }
}

/// Of some lanes of the packet.
template <Query query>
void meet_triangle(RayPacket& packet, std::uint32_t lanes, const ClusterRecord& cluster,
                   std::size_t t, Arbiter& arbiter) {
    const std::uint32_t triangle = cluster.triangle[t];
    const bool is_masked = (cluster.masked >> t & 1U) != 0;
    for (int i = 0; i < packet_size; i += step()) {
        if ((lanes >> i & ((1U << step()) - 1)) == 0) continue;
        Answer answer = test<query>(packet, i, lanes, cluster, t);
        if (is_masked) {
            answer.undecided = hn::Or(answer.undecided, answer.met);
            answer.met = hn::AndNot(answer.met, answer.met);
        }
        if (!hn::AllFalse(floats, answer.met)) {
            if constexpr (query == Query::nearest)
                keep_nearest(packet, i, answer, triangle, arbiter);
            else
                keep<query>(packet, bits_of(answer.met, i), triangle, cluster.copies[t]);
        }
        if (hn::AllFalse(floats, answer.undecided)) continue;
        alignas(64) Lanes<float> hi; // NOLINT: those that are read are set
        hn::Store(answer.hi, floats, hi.data());
        for (std::uint32_t left = bits_of(answer.undecided, 0); left != 0; left &= left - 1) {
            const int lane = __builtin_ctz(left);
            arbiter.decide(packet, i + lane, triangle, hi[static_cast<std::size_t>(lane)]);
        }
    }
}

/// A query under way.
struct Search {
    RayPacket& packet;
    RecordCache& records;
    Arbiter& arbiter;
    double ratio = 1; ///< the walk's scale over the view's
};

/// One bit per triangle that some lane may meet. For each edge, w . edge is at most the sum of the
/// larger products by component. That sum is off by less than the most |w|, as each lane's own is
/// (records.h); so where it is below three times that, no lane's own is above its |w|.
std::uint32_t members_near(const RayPacket& packet, const ClusterRecord& cluster) {
    constexpr hn::CappedTag<float, cluster_capacity> eight;
    const auto limit = hn::Set(eight, -3 * packet.most_magnitude);
    std::uint32_t near = 0;
    for (std::size_t i = 0; i < cluster_capacity; i += hn::Lanes(eight)) {
        auto least = hn::Set(eight, std::numeric_limits<float>::infinity());
        for (const std::array<PerTriangle<float>, 3>& edge : cluster.edge) {
            auto most = hn::Zero(eight);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const auto e = hn::Load(eight, edge[axis].data() + i);
                most = hn::Add(most, hn::Max(hn::Mul(hn::Set(eight, packet.least_w[axis]), e),
                                             hn::Mul(hn::Set(eight, packet.most_w[axis]), e)));
            }
            least = hn::Min(least, most);
        }
        // Not below: what is no number is near.
        alignas(8) std::array<std::uint8_t, 8> bytes{};
        hn::StoreMaskBits(eight, hn::Not(hn::Lt(least, limit)), bytes.data());
        near |= static_cast<std::uint32_t>(bytes[0]) << i;
    }
    return near & cluster.members;
}

constexpr std::uint32_t all_lanes = (1U << packet_size) - 1;

template <Query query>
void meet_cluster(Search& search, std::uint32_t number, std::uint32_t lanes) {
    const ClusterRecord& cluster = search.records.of(number);
    for (std::uint32_t left = members_near(search.packet, cluster); left != 0; left &= left - 1)
        meet_triangle<query>(search.packet, lanes, cluster,
                             static_cast<std::size_t>(__builtin_ctz(left)), search.arbiter);
}

/// How far the walk must still look: where 1/s is best_lo; of parallel rays, which are walked from
/// above, where the height is. A little further, as best_lo is rounded to float and scaled.
void lower_limits(const Search& search, int first, int count, float* far) {
    const RayPacket& packet = search.packet;
    for (int i = 0; i < count; ++i) {
        const auto l = static_cast<std::size_t>(first + i);
        const double best = packet.best_lo[l];
        double s = 0;
        if (search.records.view().parallel) {
            if (std::isinf(best)) continue;
            s = -search.ratio * best / packet.unit[l];
            s += 0x1p-20 * std::abs(s);
        } else {
            if (!(best > 0)) continue;
            s = search.ratio / best * (1 + 0x1p-20);
        }
        s -= packet.walk_start[l];
        far[i] = std::min(far[i], static_cast<float>(std::max(s, 0.0)) + 0x1p-20F);
    }
}

template <Query query>
void visit(void* visitor, std::uint32_t cluster, int first, int count, float* far) {
    auto& search = *static_cast<Search*>(visitor);
    [[maybe_unused]] const std::uint32_t before = search.packet.active;
    meet_cluster<query>(search, cluster, ((1U << count) - 1) << first);
    if constexpr (query == Query::nearest) {
        if (search.packet.best_raised) lower_limits(search, first, count, far);
        search.packet.best_raised = false;
    }
    if constexpr (query == Query::any) {
        for (int i = 0; i < count; ++i)
            if ((search.packet.active >> (first + i) & 1U) == 0)
                far[i] = -std::numeric_limits<float>::infinity();
        if (search.packet.active != before) search.records.set_last_met(cluster);
    }
}

template <Query query>
void search_for(RayPacket& packet, RecordCache& records, Arbiter& arbiter) {
    prepare(packet, records.view(), query == Query::nearest);
    const BoxTrees& trees = *records.view().trees;
    Search search{packet, records, arbiter, trees.frame().scale / records.view().scale};
    packet.walk.lanes = packet.active;
    if (packet.active != 0) {
        if (const BoxTree* tree = trees.with_room(packet.room)) {
            if constexpr (query == Query::any) {
                // A shadow needs one witness, and a neighbour's often is one.
                meet_cluster<query>(search, records.last_met(), all_lanes);
                packet.walk.lanes = packet.active;
            }
            if constexpr (query == Query::any)
                tree->find_any(packet.walk, visit<query>, &search);
            else if constexpr (query == Query::nearest)
                tree->find_nearest(packet.walk, visit<query>, &search);
            else
                tree->find_all(packet.walk, visit<query>, &search);
        } else {
            const std::size_t count = trees.clusters().all.size();
            for (std::size_t i = 0; i < count && packet.active != 0; ++i)
                meet_cluster<query>(search, static_cast<std::uint32_t>(i), all_lanes);
        }
    }
    arbiter.settle(packet);
}

// Vectors as wide as those that read them: what is stored in pieces is read late.
void fill(Lanes<float>& lanes, float value) {
    for (int i = 0; i < packet_size; i += step())
        hn::Store(hn::Set(floats, value), floats, lanes.data() + i);
}
void fill(Lanes<std::uint32_t>& lanes, std::uint32_t value) {
    for (int i = 0; i < packet_size; i += step())
        hn::Store(hn::Set(ids, value), ids, lanes.data() + i);
}

void clear_lanes(RayPacket& packet) {
    fill(packet.hit, no_triangle);
    fill(packet.hit_hi, -std::numeric_limits<float>::infinity());
    fill(packet.best_lo, -std::numeric_limits<float>::infinity());
    fill(packet.crossed, 0);
    fill(packet.skip, no_plane);
}

void set_all_lanes(RayPacket& packet, const Vectors& directions, const HitLimits& limits) {
    constexpr hn::CappedTag<double, packet_size> doubles;
    for (std::size_t i = 0; i < packet_size; i += hn::Lanes(doubles)) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            hn::Store(hn::Load(doubles, directions.axis[axis].data() + i), doubles,
                      packet.direction.axis[axis].data() + i);
        hn::Store(hn::Zero(doubles), doubles, packet.direction_error.data() + i);
    }
    fill(packet.lower_lo, limits.lower_lo);
    fill(packet.lower_hi, limits.lower_hi);
    fill(packet.upper_lo, limits.upper_lo);
    fill(packet.upper_hi, limits.upper_hi);
}

void find_nearest(RayPacket& packet, RecordCache& records, Arbiter& arbiter) {
    search_for<Query::nearest>(packet, records, arbiter);
}
void find_any(RayPacket& packet, RecordCache& records, Arbiter& arbiter) {
    search_for<Query::any>(packet, records, arbiter);
}
void find_lowest(RayPacket& packet, RecordCache& records, Arbiter& arbiter) {
    search_for<Query::lowest>(packet, records, arbiter);
}
void count_all(RayPacket& packet, RecordCache& records, Arbiter& arbiter) {
    search_for<Query::count>(packet, records, arbiter);
}

} // namespace
} // namespace shadowproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shadowproof {

namespace {
HWY_EXPORT(clear_lanes);
HWY_EXPORT(set_all_lanes);
HWY_EXPORT(find_nearest);
HWY_EXPORT(find_any);
HWY_EXPORT(find_lowest);
HWY_EXPORT(count_all);
} // namespace

void find_nearest(RayPacket& packet, RecordCache& records, Arbiter& arbiter) {
    HWY_DYNAMIC_DISPATCH(find_nearest)(packet, records, arbiter);
}
void find_any(RayPacket& packet, RecordCache& records, Arbiter& arbiter) {
    HWY_DYNAMIC_DISPATCH(find_any)(packet, records, arbiter);
}
void find_lowest(RayPacket& packet, RecordCache& records, Arbiter& arbiter) {
    HWY_DYNAMIC_DISPATCH(find_lowest)(packet, records, arbiter);
}
void count_all(RayPacket& packet, RecordCache& records, Arbiter& arbiter) {
    HWY_DYNAMIC_DISPATCH(count_all)(packet, records, arbiter);
}

void clear(RayPacket& packet, Filters filters) {
    packet.active = 0;
    packet.trusted_error = filters == Filters::off ? -1 : RayPacket::usual_trusted_error;
    HWY_DYNAMIC_DISPATCH(clear_lanes)(packet);
}

void set_lane(RayPacket& packet, int lane, const ApproximateDirection& w, const HitLimits& limits,
              std::uint32_t skip) {
    const auto l = static_cast<std::size_t>(lane);
    packet.direction.set(l, w.direction);
    packet.direction_error[l] = w.error;
    packet.lower_lo[l] = limits.lower_lo;
    packet.lower_hi[l] = limits.lower_hi;
    packet.upper_lo[l] = limits.upper_lo;
    packet.upper_hi[l] = limits.upper_hi;
    packet.skip[l] = skip;
    packet.active |= 1U << l;
}

void set_lanes(RayPacket& packet, std::uint32_t lanes, const Vectors& directions,
               const HitLimits& limits) {
    HWY_DYNAMIC_DISPATCH(set_all_lanes)(packet, directions, limits);
    packet.active |= lanes;
}

} // namespace shadowproof
#endif
