#include "reference/prediction.h"

#include "reference/faces.h"
#include "reference/parallel.h"
#include "reference/tally.h"

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace shadowproof {

namespace {

/// Whether the formulas of shadow depths hold: each face counts by one, whichever comes first, and
/// all faces are drawn but the dark cap at infinity.
bool follows_from_depths(const Counting& counting) {
    return counting.operation != Counting::Operation::saturate && counting.light_cap;
}

std::int32_t count_from_depths(const ShadowDepths& depths, const GroundTruth& truth, int x, int y,
                               const Counting& counting, const DepthModel& depth_model) {
    const bool infinite = !depth_model.finite();
    const bool background = truth.triangle.at(x, y) == no_triangle;
    const std::int32_t near = depths.at_near.at(x, y);
    // A clamped or finite picture's background is at its far plane, an infinite one's at infinity.
    std::int32_t at_surface = depths.at_surface.at(x, y);
    if (background) at_surface = infinite ? depths.at_infinity.at(x, y) : depths.at_far.at(x, y);
    at_surface += start_of(counting, depths.at_eye, near);
    if (counting.test == Counting::Test::depth_pass)
        return at_surface - (counting.depth_clamp ? depths.at_eye : near);
    // Faces past a far plane that clips are lost, and with them what contains that plane.
    if (!infinite && !counting.depth_clamp) return at_surface - depths.at_far.at(x, y);
    if (!counting.dark_cap) return at_surface - depths.at_infinity.at(x, y);
    return at_surface;
}

double depth_of_seen(const Scene& scene, std::uint32_t seen, const glm::dvec3& direction) {
    const Corners t =
        from_short_edge({corner(scene, seen, 0), corner(scene, seen, 1), corner(scene, seen, 2)});
    return depth_on_plane(scene.camera.eye, direction, t.a, cap_plane(t));
}

} // namespace

std::string_view name_of(Counting::Test test) {
    return test == Counting::Test::depth_pass ? "depth_pass" : "depth_fail";
}

std::string_view name_of(Counting::Operation operation) {
    switch (operation) {
    case Counting::Operation::wrap:
        break;
    case Counting::Operation::saturate:
        return "saturate";
    case Counting::Operation::invert:
        return "invert";
    }
    return "wrap";
}

std::string_view name_of(Counting::Start start) {
    switch (start) {
    case Counting::Start::zero:
        break;
    case Counting::Start::eye:
        return "eye";
    case Counting::Start::near_plane:
        return "near_plane";
    }
    return "zero";
}

std::int32_t start_of(const Counting& counting, std::int32_t at_eye, std::int32_t at_near) {
    switch (counting.start) {
    case Counting::Start::zero:
        break;
    case Counting::Start::eye:
        return at_eye;
    case Counting::Start::near_plane:
        return at_near;
    }
    return 0;
}

std::int64_t stepped(std::int64_t count, std::int64_t by, const Counting& counting) {
    if (counting.operation != Counting::Operation::saturate) return count + by;
    const std::int64_t most = (std::int64_t{1} << counting.bits) - 1;
    return std::clamp<std::int64_t>(count + by, 0, most);
}

namespace {

/// In the order in which they are drawn, where that matters: the sum is the same in any, unless it
/// stops at a limit on its way.
void sort_as_drawn(std::vector<PossibleFace>& faces, const Counting& counting) {
    // Caps of turned triangles are drawn among the turned faces.
    for (auto& [face, certain] : faces)
        if (face.part == Crossing::Part::light_cap && face.triangle < counting.turned.size())
            face.turned = counting.turned[face.triangle] != 0;
    if (counting.operation != Counting::Operation::saturate) return;
    const auto key = [](const PossibleFace& possible) {
        const Crossing& face = possible.face;
        const auto kind = face.is_side() ? Crossing::Part::side_0 : face.part;
        return std::tuple(face.turned, kind, face.is_side() ? face.edge : face.triangle);
    };
    std::stable_sort(faces.begin(), faces.end(),
                     [&](const PossibleFace& a, const PossibleFace& b) { return key(a) < key(b); });
}

/// Calls step(by, certain) for each face as it is drawn, dark caps before turned faces.
template <class Step>
void draw(const std::vector<PossibleFace>& faces, std::int64_t dark_caps, const Counting& counting,
          const Step& step) {
    const bool any_order = counting.operation != Counting::Operation::saturate;
    auto face = faces.begin();
    const auto draw_while = [&](bool turned) {
        for (; face != faces.end() && (turned || !face->face.turned); ++face)
            step(weight(counting, face->face) * face->face.change, face->certain);
    };
    draw_while(any_order);
    for (std::int64_t i = 0; i < dark_caps; ++i) step(-weight(Counting::Test::depth_fail), true);
    draw_while(true);
}

} // namespace

std::vector<std::int64_t> possible_counts(std::vector<PossibleFace> faces, std::int64_t start,
                                          std::int64_t dark_caps, const Counting& counting) {
    sort_as_drawn(faces, counting);
    std::set<std::int64_t> counts{start};
    draw(faces, dark_caps, counting, [&](int by, bool certain) {
        std::set<std::int64_t> after;
        for (const std::int64_t count : counts) {
            after.insert(stepped(count, by, counting));
            if (!certain) after.insert(count);
        }
        counts = std::move(after);
    });
    return {counts.begin(), counts.end()};
}

std::vector<std::int64_t> possible_counts_of_sum(std::vector<PossibleFace> faces,
                                                 std::int64_t start, std::int64_t dark_caps,
                                                 const Counting& counting, std::int64_t sum) {
    sort_as_drawn(faces, counting);
    using Counts = std::set<std::pair<std::int64_t, std::int64_t>>; // by sum
    Counts counts{{start, start}};
    draw(faces, dark_caps, counting, [&](int by, bool certain) {
        Counts after;
        for (const auto& [so_far, count] : counts) {
            after.emplace(so_far + by, stepped(count, by, counting));
            if (!certain) after.emplace(so_far, count);
        }
        counts = std::move(after);
    });
    std::vector<std::int64_t> possible;
    for (const auto& [found, count] : counts)
        if (found == sum) possible.push_back(count);
    return possible;
}

std::int64_t counted_in_order(const std::vector<Crossing>& faces, std::int64_t start,
                              std::int64_t dark_caps, const Counting& counting) {
    std::vector<PossibleFace> certain;
    certain.reserve(faces.size());
    for (const Crossing& face : faces) certain.push_back({face, true});
    return possible_counts(std::move(certain), start, dark_caps, counting).front();
}

std::int64_t counted(const CountedRay& ray, double far, const Counting& counting,
                     const DepthModel& depth_model) {
    std::vector<Crossing> drawn;
    for (const Crossing& crossing : ray.crossings)
        if (tally(crossing, ray.surface, ray.seen, far, counting, depth_model) == Tally::counted)
            drawn.push_back(crossing);
    // A ray that ends inside volumes leaves them through their dark caps at infinity.
    const bool caps = tally_of_dark_caps(counting, depth_model) == Tally::counted;
    return counted_in_order(drawn, start_of(counting, ray.at_eye, ray.at_near),
                            caps ? dark_caps_at_infinity(counting, ray.at_eye, ray.crossings) : 0,
                            counting);
}

Prediction::Prediction(const Tracer& tracer, const Silhouette& silhouette, const GroundTruth& truth,
                       const ShadowDepths& depths, const Counting& counting,
                       const DepthModel& depth_model)
    : volumes_(tracer, silhouette, counting), depths_(volumes_.shadow_depths(truth, depths)) {
    if (!volumes_.are_ideal()) ideal_depths_ = volumes_.ideal_depths(truth, depths);
    const Camera& camera = tracer.scene().camera;
    counts_ = Image<std::int32_t>(camera.width, camera.height);
    const bool simple = follows_from_depths(counting);
    const int columns = (camera.width + region_side - 1) / region_side;
    const int rows = (camera.height + region_side - 1) / region_side;
    parallel_for(columns * rows, tracer.threads(), [&](int region, int) {
        const int left = region % columns * region_side;
        const int top = region / columns * region_side;
        const int right = std::min(left + region_side, camera.width);
        const int bottom = std::min(top + region_side, camera.height);
        if (simple) {
            for (int y = top; y < bottom; ++y)
                for (int x = left; x < right; ++x)
                    counts_.at(x, y) =
                        count_from_depths(depths_, truth, x, y, counting, depth_model);
            return;
        }
        RegionLedger ledger = volumes_.ledger(corner_rays(camera, left, top, right, bottom));
        std::vector<Crossing> crossings;
        for (int y = top; y < bottom; ++y)
            for (int x = left; x < right; ++x) {
                const glm::dvec3 direction = ray_direction(camera, x + 0.5, y + 0.5);
                ledger.crossings(direction, crossings);
                const std::uint32_t seen = truth.triangle.at(x, y);
                const double surface =
                    seen == no_triangle ? 0 : depth_of_seen(tracer.scene(), seen, direction);
                const CountedRay ray{crossings, surface, seen, depths_.at_eye,
                                     depths_.at_near.at(x, y)};
                counts_.at(x, y) =
                    static_cast<std::int32_t>(counted(ray, depths.far, counting, depth_model));
            }
    });
}

} // namespace shadowproof
