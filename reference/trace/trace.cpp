#include "reference/trace/trace.h"

#include "reference/trace/tiles.h"
#include "reference/walk/embree_device.h"
#include "reference/walk/instruction_set.h"
#include "scenes/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace shadowproof {

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

void check(const Scene& scene) {
    const std::string where = scene.file.empty() ? scene.name : scene.file.string();
    if (scene.triangles.empty())
        throw Error(where, "has no triangles", "give it a mesh with triangles");
}

/// A spot light's cone; its cosine is that of the outer angle as std::cos rounds it.
std::optional<Cone> cone_of(const Light& light) {
    if (light.kind != Light::Kind::spot) return std::nullopt;
    return Cone{light.position, light.direction, std::cos(light.outer_cone)};
}

/// Removes from a view the triangles that do not cast.
void keep_casters(const Scene& scene, OriginView& view) {
    const std::vector<std::uint8_t> casts = casting_triangles(scene);
    for (std::size_t i = 0; i < casts.size(); ++i)
        if (casts[i] == 0) view.side[i] = 0;
}

std::vector<std::uint8_t> facing_of(const Tracer::State& state) {
    std::vector<std::uint8_t> bits(state.receives.size());
    for (std::size_t i = 0; i < bits.size(); ++i) {
        const int eye = state.from_eye.side[i];
        const int light = state.side_of_light[i];
        const Places& places = state.places;
        const bool copied = places.first[i] != i || places.next[i] != no_triangle;
        bits[i] = static_cast<std::uint8_t>(
            (eye * light > 0 ? faces_light_bit : 0) | (light == 0 ? edge_on_bit : 0) |
            (state.receives[i] != 0 ? receives_bit : 0) | (copied ? copied_bit : 0));
    }
    return bits;
}

} // namespace

Tracer::Tracer(const Scene& scene, int threads) : state_(std::make_unique<State>()) {
    check(scene);
    choose_instruction_set();
    const Clock::time_point start = Clock::now();
    State& state = *state_;
    state.scene = &scene;
    state.threads = thread_count(threads);
    state.places = find_places(scene, state.predicates, state.threads);
    state.clusters =
        build_clusters(scene, state.places.firsts(), state.places.plane, state.threads);
    state.trees.emplace(state.clusters, state.threads);
    state.double_sided = double_sided_triangles(scene);
    state.receives = receiving_triangles(scene);
    state.masks = masks_of_triangles(scene);
    state.eye = homogeneous_eye(scene.camera);
    state.light = homogeneous(chosen_light(scene));
    state.cone = cone_of(chosen_light(scene));
    const auto from = [&](const glm::dvec4& origin, bool may_be_parallel) {
        return view_from(origin, may_be_parallel, scene, *state.trees, state.places,
                         state.predicates, state.threads);
    };
    state.from_eye = from(state.eye, false);
    state.from_light = from(state.light, true);
    state.side_of_light = state.from_light.side;
    state.facing = facing_of(state);
    keep_casters(scene, state.from_light);
    set_cluster_sides(state.from_eye, state.double_sided);
    set_cluster_sides(state.from_light, state.double_sided);
    state.build_milliseconds = milliseconds_since(start);
}

Tracer::~Tracer() = default;
Tracer::Tracer(Tracer&&) noexcept = default;
Tracer& Tracer::operator=(Tracer&&) noexcept = default;

const Scene& Tracer::scene() const {
    return *state_->scene;
}
int Tracer::threads() const {
    return state_->threads;
}

namespace {

void count_classes(const GroundTruth& truth, TraceStatistics& statistics) {
    for (const Visibility visibility : truth.visibility.pixels) {
        statistics.lit += visibility == Visibility::lit;
        statistics.shadowed += visibility == Visibility::shadowed;
        statistics.background += visibility == Visibility::background;
    }
    statistics.degenerate = static_cast<std::uint64_t>(std::count(
        truth.exactness.pixels.begin(), truth.exactness.pixels.end(), Exactness::degenerate));
}

} // namespace

GroundTruth trace(const Tracer& tracer, Filters filters) {
    const Tracer::State& state = tracer.state();
    const Camera& camera = state.scene->camera;
    const Clock::time_point start = Clock::now();
    GroundTruth truth;
    truth.visibility = Image<Visibility>(camera.width, camera.height);
    truth.triangle = Image<std::uint32_t>(camera.width, camera.height, no_triangle);
    truth.depth = Image<double>(camera.width, camera.height);
    truth.exactness = Image<Exactness>(camera.width, camera.height);
    if (state.cone) truth.in_cone = Image<std::uint8_t>(camera.width, camera.height);

    const auto probers = for_tiles(
        state,
        [&](Prober& prober, const Tile& tile) {
            thread_local SeenLanes seen;
            thread_local LitLanes lighting;
            prober.see(tile.lines, tile.lanes, seen);
            prober.light(tile.lines, tile.lanes, seen, lighting);
            for (std::size_t lane = 0; lane < packet_size; ++lane)
                lighting.exactness[lane] = std::max(lighting.exactness[lane], seen.exactness[lane]);
            tile.copy(lighting.visibility, truth.visibility);
            tile.copy(lighting.exactness, truth.exactness);
            tile.copy(seen.triangle, truth.triangle);
            tile.copy(seen.depth, truth.depth);
            if (state.cone) {
                for (std::size_t lane = 0; lane < packet_size; ++lane)
                    if (seen.triangle[lane] == no_triangle) lighting.in_cone[lane] = 0;
                tile.copy(lighting.in_cone, truth.in_cone);
            }
        },
        filters);

    TraceStatistics& statistics = truth.statistics;
    for (const auto& prober : probers) {
        statistics.rays += prober->rays();
        statistics.exact_decisions += prober->exact_decisions();
        statistics.undecided += prober->undecided();
    }
    statistics.milliseconds = milliseconds_since(start);
    statistics.build_milliseconds = state.build_milliseconds;
    count_classes(truth, statistics);
    return truth;
}

namespace {

/// Calls work(prober, packet, lanes, first) for sixteen rays at a time, on all threads; `first`:
/// the index of the packet's first ray. `line`: of each ray, by its index.
template <class Line, class Work>
void for_packets(const Tracer::State& state, std::size_t rays, const Line& line, const Work& work) {
    std::vector<std::unique_ptr<Prober>> probers(static_cast<std::size_t>(state.threads));
    constexpr std::size_t piece_size = std::size_t{64} * packet_size;
    const auto pieces = static_cast<int>((rays + piece_size - 1) / piece_size);
    parallel_for(pieces, state.threads, [&](int piece, int thread) {
        std::unique_ptr<Prober>& prober = probers[static_cast<std::size_t>(thread)];
        if (!prober) prober = std::make_unique<Prober>(state);
        const std::size_t begin = static_cast<std::size_t>(piece) * piece_size;
        const std::size_t end = std::min(rays, begin + piece_size);
        for (std::size_t first = begin; first < end; first += packet_size) {
            const std::size_t count = std::min<std::size_t>(packet_size, end - first);
            Vectors packet;
            for (std::size_t lane = 0; lane < count; ++lane) packet.set(lane, line(first + lane));
            work(*prober, packet, (1U << count) - 1, first);
        }
    });
}

/// `first`: the packet's first ray in the list.
void see_with(Prober& prober, const Vectors& packet, std::uint32_t lanes, std::size_t first,
              const SeenRange& range, const MaskLeeway& leeway, SeenLanes& seen) {
    if (leeway.readings.empty()) return prober.see(packet, lanes, range, nullptr, seen);
    PacketMasks masks{.errors = leeway.errors};
    for (std::size_t lane = 0; (lanes >> lane & 1U) != 0; ++lane)
        masks.readings[lane] = leeway.readings[first + lane];
    prober.see(packet, lanes, range, &masks, seen);
}

} // namespace

std::vector<RayTruth> trace_rays(const Tracer& tracer, std::span<const glm::dvec3> lines,
                                 const MaskLeeway& leeway) {
    return trace_rays(tracer, lines, leeway, range_of(tracer.scene().camera));
}

std::vector<RayTruth> trace_rays(const Tracer& tracer, std::span<const glm::dvec3> lines,
                                 const MaskLeeway& leeway, const SeenRange& range) {
    std::vector<RayTruth> truths(lines.size());
    for_packets(
        tracer.state(), lines.size(), [&](std::size_t i) { return lines[i]; },
        [&](Prober& prober, const Vectors& packet, std::uint32_t lanes, std::size_t first) {
            SeenLanes seen;
            LitLanes lighting;
            see_with(prober, packet, lanes, first, range, leeway, seen);
            prober.light(packet, lanes, seen, lighting);
            for (std::size_t lane = 0; (lanes >> lane & 1U) != 0; ++lane)
                truths[first + lane] = {lighting.visibility[lane], seen.triangle[lane],
                                        seen.depth[lane],
                                        std::max(seen.exactness[lane], lighting.exactness[lane]),
                                        lighting.in_cone[lane] != 0};
        });
    return truths;
}

std::uint32_t occluder_of(const Tracer& tracer, const glm::dvec3& line) {
    Prober prober(tracer.state());
    Vectors lines;
    lines.set(0, line);
    SeenLanes seen;
    Lanes<std::uint32_t> triangles{};
    prober.see(lines, 1, seen);
    prober.occluders(lines, 1, seen, triangles);
    return triangles[0];
}

std::vector<SeenSurface> see_rays(const Tracer& tracer, std::span<const glm::dvec3> lines,
                                  const MaskLeeway& leeway) {
    const SeenRange range = range_of(tracer.scene().camera);
    std::vector<SeenSurface> surfaces(lines.size());
    for_packets(
        tracer.state(), lines.size(), [&](std::size_t i) { return lines[i]; },
        [&](Prober& prober, const Vectors& packet, std::uint32_t lanes, std::size_t first) {
            SeenLanes seen;
            see_with(prober, packet, lanes, first, range, leeway, seen);
            for (std::size_t lane = 0; (lanes >> lane & 1U) != 0; ++lane)
                surfaces[first + lane] = {seen.triangle[lane], seen.depth[lane]};
        });
    return surfaces;
}

SeenRange range_of(const Camera& camera) {
    return {camera.near, camera.far};
}

void see_triangles(const Tracer& tracer, const SeenRange& range, std::size_t rays,
                   const std::function<glm::dvec3(std::size_t)>& line,
                   const std::function<void(std::size_t, std::uint32_t)>& found) {
    for_packets(tracer.state(), rays, line,
                [&](Prober& prober, const Vectors& packet, std::uint32_t lanes, std::size_t first) {
                    SeenLanes seen;
                    prober.see_triangle(packet, lanes, range, seen);
                    for (std::size_t lane = 0; (lanes >> lane & 1U) != 0; ++lane)
                        found(first + lane, seen.triangle[lane]);
                });
}

RayTruth trace_ray(const Tracer& tracer, const glm::dvec3& line) {
    return trace_rays(tracer, std::span(&line, 1)).front();
}

namespace {
/// The version whose walk the bound in box_tree.cpp was read off.
constexpr const char* proven_embree = "3.13.5";
} // namespace

std::string embree_version() {
    const EmbreeDevice device(rtcNewDevice(nullptr));
    const auto part = [&](RTCDeviceProperty property) {
        return static_cast<long>(rtcGetDeviceProperty(device.get(), property));
    };
    return fmt::format("{}.{}.{}", part(RTC_DEVICE_PROPERTY_VERSION_MAJOR),
                       part(RTC_DEVICE_PROPERTY_VERSION_MINOR),
                       part(RTC_DEVICE_PROPERTY_VERSION_PATCH));
}

std::optional<std::string> note_on_embree(const std::string& version) {
    if (version == proven_embree) return std::nullopt;
    return fmt::format("Embree {} finds what rays may meet; that it loses nothing was shown of {}",
                       version, proven_embree);
}

TriangleSides sides_of(const Tracer& tracer, std::uint32_t triangle) {
    const Tracer::State& state = tracer.state();
    const std::int8_t eye = state.from_eye.side[triangle];
    const std::int8_t light = state.side_of_light[triangle];
    return {eye<0, eye> 0, light<0, light> 0,
            eye < 0 || (eye > 0 && state.double_sided[triangle] != 0)};
}

} // namespace shadowproof
