#include "reference/predict/prediction.h"

#include "reference/parallel.h"
#include "reference/predict/tally.h"
#include "reference/trace/faces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace shadowproof {

namespace {

/// Whether the formulas of shadow depths hold: each face counts by one, whatever the order, and all
/// faces are drawn but the dark cap at infinity.
bool follows_from_depths(const Counting& counting) {
    return counting.operation != Counting::Operation::saturate && counting.light_cap;
}

std::int32_t count_from_depths(const ShadowDepths& depths, const GroundTruth& truth, int x, int y,
                               const CountingModel& model) {
    const Counting& counting = model.counting;
    const bool background = truth.triangle.at(x, y) == no_triangle;
    // A near plane at the eye clips nothing.
    const bool clips_near = model.depth_model.parallel ? std::isfinite(model.depth_model.near)
                                                       : model.depth_model.near > 0;
    const std::int32_t near = clips_near ? depths.at_near.at(x, y) : depths.at_eye;
    std::int32_t at_surface = depths.at_surface.at(x, y);
    if (background)
        at_surface = model.depth_model.background_at_far() ? depths.at_far.at(x, y)
                                                           : depths.at_infinity.at(x, y);
    at_surface += start_of(counting, depths.at_eye, near);
    if (counting.test == Counting::Test::depth_pass)
        return at_surface - (model.depth_model.clamp ? depths.at_eye : near);
    // Faces past a far plane that clips are lost, and with them what contains that plane.
    if (model.depth_model.clips_at_far()) return at_surface - depths.at_far.at(x, y);
    if (!counting.dark_cap) return at_surface - depths.at_infinity.at(x, y);
    return at_surface;
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

/// Sorts faces in drawing order, where that matters: the sum is the same in any order, unless it
/// stops at a limit on its way.
void sort_as_drawn(std::vector<PossibleFace>& faces, const Counting& counting) {
    if (counting.operation != Counting::Operation::saturate) return;
    const auto key = [](const PossibleFace& possible) {
        const Crossing& face = possible.face;
        const auto kind = face.is_side() ? Crossing::Part::side_0 : face.part;
        return std::tuple(face.flipped, kind, face.is_side() ? face.edge : face.triangle);
    };
    std::stable_sort(faces.begin(), faces.end(),
                     [&](const PossibleFace& a, const PossibleFace& b) { return key(a) < key(b); });
}

/// Calls step(by, certain) for each face in drawing order, dark caps before flipped faces or first.
template <class Step>
void draw(const std::vector<PossibleFace>& faces, std::int64_t dark_caps, const Counting& counting,
          const Step& step) {
    const bool any_order = counting.operation != Counting::Operation::saturate;
    auto face = faces.begin();
    const auto draw_while = [&](bool flipped) {
        for (; face != faces.end() && (flipped || !face->face.flipped); ++face)
            step(weight(counting, face->face) * face->face.change, face->certain);
    };
    const auto draw_caps = [&] {
        for (std::int64_t i = 0; i < dark_caps; ++i)
            step(-weight(Counting::Test::depth_fail), true);
    };
    if (counting.caps_first) draw_caps();
    draw_while(any_order);
    if (!counting.caps_first) draw_caps();
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

std::vector<CountOfSum> possible_sums(std::vector<PossibleFace> faces, std::int64_t start,
                                      std::int64_t dark_caps, const Counting& counting) {
    sort_as_drawn(faces, counting);
    std::set<CountOfSum> counts{{start, start}};
    draw(faces, dark_caps, counting, [&](int by, bool certain) {
        std::set<CountOfSum> after;
        for (const auto& [sum, count] : counts) {
            after.insert({sum + by, stepped(count, by, counting)});
            if (!certain) after.insert({sum, count});
        }
        counts = std::move(after);
    });
    return {counts.begin(), counts.end()};
}

std::vector<std::int64_t> possible_counts_of_sum(std::vector<PossibleFace> faces,
                                                 std::int64_t start, std::int64_t dark_caps,
                                                 const Counting& counting, std::int64_t sum) {
    std::vector<std::int64_t> possible;
    for (const CountOfSum& found : possible_sums(std::move(faces), start, dark_caps, counting))
        if (found.sum == sum) possible.push_back(found.count);
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

/// Results for limitations requested so far.
struct Prediction::Cache {
    std::mutex mutex;
    std::map<Limitations, CountingModel> models;
    std::map<Limitations, std::shared_ptr<const CountedVolumes>> volumes; ///< by of_volumes
    std::map<Limitations, std::unique_ptr<Image<std::int32_t>>> counts;
};

Prediction::Prediction(const VolumeStore& store, const Counting& counting,
                       const DepthModel& depth_model)
    : store_(&store), model_{counting, depth_model}, own_(store.counted(counting)),
      counts_(count_all(*own_, model_)), cache_(std::make_unique<Cache>()) {}
Prediction::~Prediction() = default;
Prediction::Prediction(Prediction&&) noexcept = default;

Image<std::int32_t> Prediction::count_all(const CountedVolumes& made,
                                          const CountingModel& model) const {
    const ShadowDepths& depths = *made.depths;
    const Scene& scene = store_->tracer().scene();
    const GroundTruth& truth = store_->truth();
    const Camera& camera = scene.camera;
    Image<std::int32_t> counts(camera.width, camera.height);
    const bool simple = follows_from_depths(model.counting);
    const int columns = (camera.width + region_side - 1) / region_side;
    const int rows = (camera.height + region_side - 1) / region_side;
    parallel_for(columns * rows, store_->tracer().threads(), [&](int region, int) {
        const int left = region % columns * region_side;
        const int top = region / columns * region_side;
        const int right = std::min(left + region_side, camera.width);
        const int bottom = std::min(top + region_side, camera.height);
        if (simple) {
            for (int y = top; y < bottom; ++y)
                for (int x = left; x < right; ++x)
                    counts.at(x, y) = count_from_depths(depths, truth, x, y, model);
            return;
        }
        RegionLedger ledger = made.volumes.ledger(corner_lines(camera, left, top, right, bottom));
        std::vector<Crossing> crossings;
        for (int y = top; y < bottom; ++y)
            for (int x = left; x < right; ++x) {
                const glm::dvec3 line = line_of_sight(camera, x + 0.5, y + 0.5);
                ledger.crossings(line, crossings);
                const std::uint32_t seen = truth.triangle.at(x, y);
                const double surface =
                    seen == no_triangle ? 0 : depth_on_triangle(scene, seen, line);
                const CountedRay ray{crossings, surface, seen, depths.at_eye,
                                     depths.at_near.at(x, y)};
                counts.at(x, y) = static_cast<std::int32_t>(
                    counted(ray, depths.far, model.counting, model.depth_model));
            }
    });
    return counts;
}

const CountingModel& Prediction::without(Limitations limitations) const {
    if (limitations.empty()) return model_;
    const std::lock_guard lock(cache_->mutex);
    const auto found = cache_->models.find(limitations);
    if (found != cache_->models.end()) return found->second;
    return cache_->models.emplace(limitations, shadowproof::without(model_, limitations))
        .first->second;
}

const CountedVolumes& Prediction::volumes_without(Limitations limitations) const {
    if ((limitations & of_volumes).empty()) return *own_;
    const std::lock_guard lock(cache_->mutex);
    return lifted(limitations);
}

const CountedVolumes& Prediction::lifted(Limitations limitations) const {
    std::shared_ptr<const CountedVolumes>& found = cache_->volumes[limitations & of_volumes];
    if (!found)
        found = store_->counted(shadowproof::without(model_, limitations & of_volumes).counting);
    return *found;
}

namespace {

/// Whether dark caps are all that is missing of caps, and have no area: a sun's end in one point of
/// a perspective picture, and only the line of sight to just that point leaves no volume.
bool lacks_points_alone(const Scene& scene, const Counting& counting) {
    return counting.light_cap && std::isinf(counting.extrusion) &&
           homogeneous(chosen_light(scene)).w == 0 && !scene.camera.is_orthographic();
}

} // namespace

Limitations Prediction::limitations() const {
    const Scene& scene = store_->tracer().scene();
    Limitations found = limitations_of(model_);
    if (lacks_points_alone(scene, model_.counting)) found = found - Limitation::caps;
    return has_masks(scene) ? found | Limitation::alpha : found;
}

namespace {

/// A counter that stops at 0 had nothing to lose.
std::int64_t less(std::int64_t count, std::int64_t let_through, const Counting& counting) {
    const bool stops = counting.operation == Counting::Operation::saturate;
    return stops ? std::max<std::int64_t>(count - let_through, 0) : count - let_through;
}

} // namespace

std::int64_t Prediction::count_with_masks(Limitations limitations, int x, int y) const {
    const Limitations others = limitations - Limitation::alpha;
    const std::int64_t count = count_without(others, x, y);
    return less(count, volumes_without(others).let_through->at(x, y), without(others).counting);
}

std::int64_t Prediction::count_with_masks(Limitations limitations, const SurfaceRay& ray) const {
    const Limitations others = limitations - Limitation::alpha;
    const std::int64_t count = count_without(others, ray);
    return less(count, volumes_without(others).volumes.let_through(ray.line, ray.seen),
                without(others).counting);
}

std::int64_t Prediction::count_without(Limitations limitations, int x, int y) const {
    if (limitations.contains(Limitation::alpha)) return count_with_masks(limitations, x, y);
    if (limitations.empty()) return counts_.at(x, y);
    const CountingModel& model = without(limitations);
    const bool own_volumes = (limitations & of_volumes).empty();
    const bool simple = follows_from_depths(model.counting);
    const GroundTruth& truth = store_->truth();
    if (own_volumes && simple) return count_from_depths(*own_->depths, truth, x, y, model);
    const std::lock_guard lock(cache_->mutex);
    const CountedVolumes& made = own_volumes ? *own_ : lifted(limitations);
    if (simple) return count_from_depths(*made.depths, truth, x, y, model);
    std::unique_ptr<Image<std::int32_t>>& counts = cache_->counts[limitations];
    if (!counts) counts = std::make_unique<Image<std::int32_t>>(count_all(made, model));
    return counts->at(x, y);
}

std::int64_t Prediction::count_without(Limitations limitations, const SurfaceRay& ray) const {
    if (limitations.contains(Limitation::alpha)) return count_with_masks(limitations, ray);
    const CountingModel& model = without(limitations);
    const Tracer& tracer = store_->tracer();
    const double far = store_->depths().far;
    const CountedVolumes& made = volumes_without(limitations);
    const std::int32_t at_eye = made.depths->at_eye;
    RegionLedger ledger = made.volumes.ledger(ray.corners);
    std::vector<Crossing> crossings;
    ledger.crossings(ray.line, crossings);
    std::int32_t at_near = at_eye;
    for (Crossing& crossing : crossings) {
        const bool before_near = crossing.depth < tracer.scene().camera.near;
        if (before_near) at_near += crossing.change;
        // A visible triangle's cap lies in its surface, which hides what is not in front of it.
        if (!before_near && crossing.part == Crossing::Part::light_cap &&
            crossing.depth < ray.depth && crossing.triangle < tracer.scene().triangles.size() &&
            !has_mask(tracer.scene(), crossing.triangle) &&
            sides_of(tracer, crossing.triangle).visible && crossing.depth < far)
            crossing.depth = ray.depth;
    }
    return counted({crossings, ray.depth, ray.seen, at_eye, at_near}, far, model.counting,
                   model.depth_model);
}

} // namespace shadowproof
