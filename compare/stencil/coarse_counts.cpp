#include "compare/stencil/coarse_counts.h"

#include "compare/driver/cone_side.h"
#include "compare/driver/shown_pixel.h"
#include "compare/stencil/figures/drawn_picture.h"
#include "reference/parallel.h"
#include "reference/predict/tally.h"
#include "scenes/driver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

namespace shadowproof {

namespace {

/// What the faces of a pixel add up to.
struct FaceSums {
    bool is_coarse = false;
    StepSums counted;
    /// Changes in front of what is shown, less those before the near plane.
    StepSums in_front;

    FaceSums& operator+=(const FaceSums& other) {
        is_coarse = is_coarse || other.is_coarse;
        counted += other.counted;
        in_front += other.in_front;
        return *this;
    }
};

/// Steps of `by`, or where that is 0 of up to `copies` either way.
StepSums steps(int by, std::uint32_t copies, const Chance& taken) {
    if (!taken.possible) return {};
    const std::int64_t size = copies;
    if (by == 0) return {-size, size, size};
    const std::int64_t sum = by * size;
    const std::int64_t up = std::max<std::int64_t>(sum, 0);
    if (taken.certain) return {sum, sum, up};
    return {std::min<std::int64_t>(sum, 0), up, up};
}

Chance both(const Chance& one, const Chance& other) {
    return {one.possible && other.possible, one.certain && other.certain};
}

Chance inverse(const Chance& chance) {
    return {!chance.certain, !chance.possible};
}

/// The faces of the volumes.
class FacesAtPixels {
public:
    FacesAtPixels(const CountedClaim& judged, const DrawnPicture& picture,
                  std::span<const ShownPixel> pixels)
        : judged_(judged), picture_(picture), faces_(picture), pixels_(pixels),
          by_row_(pixels, picture.casters.camera.height),
          roundings_(window_roundings(judged.frame.depth_model)),
          nearest_(judged.frame.depth_model.clamp
                       ? std::numeric_limits<double>::infinity()
                       : nearness_of_depth(judged.frame.depth_model,
                                           judged.traced.scene().camera.near)) {}

    std::size_t count() const { return faces_.count(); }

    void add(std::size_t number, std::vector<FaceSums>& sums) const {
        if (number < picture_.faces.faces.size())
            add_face(number, sums);
        else
            add_layer(number, sums);
    }

private:
    const CountedClaim& judged_;
    const DrawnPicture& picture_;
    PicturedFaces faces_;
    std::span<const ShownPixel> pixels_;
    PixelsByRow by_row_;
    WindowRoundings roundings_;
    double nearest_; ///< nearness at which faces are clipped

    /// One triangle, or both of a side. Those share an edge: they do not overlap, or have opposite
    /// signs, wherever they are drawn, and so count once at most.
    void add_face(std::size_t number, std::vector<FaceSums>& sums) const {
        const DrawnFace& drawn = picture_.faces.faces[number];
        if (!drawn.other_corner) {
            const PicturedFace face = face_of(number);
            const bool hides_itself = never_in_front(drawn, face);
            for (const std::size_t i : by_row_.within(by_row_.rows_of(face)))
                sums[i] += sums_of(drawn, face, hides_itself, pixels_[i]);
        } else if (drawn.first_of_side) {
            const DrawnFace& second = picture_.faces.faces[number + 1];
            const PicturedFace face = face_of(number);
            const PicturedFace other = face_of(number + 1);
            const PixelRun rows = either(by_row_.rows_of(face), by_row_.rows_of(other));
            for (const std::size_t i : by_row_.within(rows)) {
                FaceSums side = sums_of(drawn, face, false, pixels_[i]);
                side += sums_of(second, other, false, pixels_[i]);
                for (StepSums* steps : {&side.counted, &side.in_front}) limit(*steps, drawn.copies);
                sums[i] += side;
            }
        }
    }

    /// A light that nearly touches a caster makes no face coarse: what it leaves open is the same
    /// at all pixels, and is judged as such.
    PicturedFace face_of(std::size_t number) const {
        PicturedFace face = faces_.face(number);
        face.margin = std::min(face.margin, faces_.margin_by_size(number));
        return face;
    }

    /// Clamped to the near plane's depth, a face is no longer before what lies there.
    NearnessRange clamped(NearnessRange range) const {
        if (!judged_.frame.depth_model.clamp) return range;
        const double most =
            nearness_of_depth(judged_.frame.depth_model, judged_.traced.scene().camera.near);
        return {std::min(range.low, most), std::min(range.high, most)};
    }

    static void limit(StepSums& steps, std::int64_t most) {
        steps.low = std::max(steps.low, -most);
        steps.high = std::min(steps.high, most);
        steps.up = std::min(steps.up, most);
    }

    FaceSums sums_of(const DrawnFace& drawn, const PicturedFace& face, bool hides_itself,
                     const ShownPixel& pixel) const {
        const Chance covered = covered_by(drawn, face, pixel);
        if (!covered.possible) return {};
        const NearnessRange range = clamped(nearness_of(face, pixel, roundings_));
        const Chance front = hides_itself || is_own(drawn, pixel) || is_at_infinity(drawn)
                                 ? Chance{}
                                 : is_in_front(range, pixel);
        const Counting::Test test = judged_.counting().caster(drawn.triangle).test;
        const bool pass = test == Counting::Test::depth_pass;
        // It may be clipped where it should not be, or the other way round.
        const bool is_cut = !covered.certain && range.high >= nearest_;
        return {is_coarse(face, covered, pixel) ||
                    (is_extruded_to_infinity(drawn) && front.possible),
                steps(weight(test) * face.change, face.copies,
                      both(covered, pass ? front : inverse(front))),
                steps(is_cut ? 0 : face.change, face.copies, both(covered, front))};
    }

    /// Volumes are entered through their layers, in front of everything; what a volume with a split
    /// far end is cut into may count either way. A layer of which no bound is known, as the light
    /// lies in the near plane or on its caster, makes no pixel coarse: it would let the counter be
    /// anything there.
    void add_layer(std::size_t number, std::vector<FaceSums>& sums) const {
        const NearLayer& layer = picture_.faces.near_layers[number - picture_.faces.faces.size()];
        const PicturedFace face = faces_.face(number);
        const bool is_bound = std::isfinite(face.margin);
        for (const std::size_t i : by_row_.within(by_row_.rows_of(face))) {
            const Chance covered = covers(face, pixels_[i]);
            sums[i].is_coarse =
                sums[i].is_coarse || (is_bound && is_coarse(face, covered, pixels_[i]));
            sums[i].counted += steps(layer.touches_light ? 0 : 1, 1, covered);
        }
    }

    bool is_extruded_to_infinity(const DrawnFace& drawn) const {
        return drawn.part == DrawnFace::Part::dark_cap && picture_.far_ends == nullptr;
    }
    /// In an infinite projection no rounding brings it nearer: its corners' depths are 0, or w.
    bool is_at_infinity(const DrawnFace& drawn) const {
        return is_extruded_to_infinity(drawn) && !judged_.frame.depth_model.finite();
    }
    bool is_own(const DrawnFace& drawn, const ShownPixel& shown) const {
        return drawn.part == DrawnFace::Part::light_cap &&
               shown.triangle - drawn.triangle < drawn.copies;
    }
    /// A light cap is drawn as its surface is: where that is drawn, too, something else is shown
    /// only if it is in front of both.
    bool never_in_front(const DrawnFace& drawn, const PicturedFace& face) const {
        const Scene& scene = judged_.traced.scene();
        if (drawn.part != DrawnFace::Part::light_cap || drawn.triangle >= scene.triangles.size() ||
            judged_.frame.depth_model.clamp || std::isfinite(scene.camera.far) ||
            has_mask(scene, drawn.triangle))
            return false;
        const bool double_sided =
            scene.materials[scene.meshes[mesh_of(scene, drawn.triangle)].material].double_sided;
        return sides_of(judged_.tracer(), drawn.triangle).visible &&
               (double_sided || face.change != 0);
    }
    /// The two triangles of a side cover a place once where it lies in both together, and then the
    /// first counts for both.
    Chance covered_by(const DrawnFace& drawn, const PicturedFace& face,
                      const ShownPixel& shown) const {
        if (is_own(drawn, shown)) return {true, drawn.certain};
        if (face.is_one_of_two && face.certain_of_both.holds(shown.centre))
            return {face.stands_for_both, face.stands_for_both};
        return covers(face, shown);
    }
};

std::vector<FaceSums> face_sums(const CountedClaim& judged, std::span<const ShownPixel> pixels) {
    const Volumes& volumes = judged.prediction.volumes();
    const DrawnFaces drawn =
        drawn_faces(volumes, judged.counting(), judged.frame.counted->volume_faces);
    const DrawnPicture picture{volumes.drawn_casters(), volumes.far_ends(), drawn, judged.frame,
                               judged.traced.far()};
    const FacesAtPixels faces(judged, picture, pixels);
    std::vector<FaceSums> sums(pixels.size());
    constexpr std::size_t together = 256;
    std::mutex mutex; // sums do not depend on their order
    parallel_for(static_cast<int>((faces.count() + together - 1) / together),
                 judged.tracer().threads(), [&](int piece, int) {
                     std::vector<FaceSums> found(pixels.size());
                     const std::size_t begin = static_cast<std::size_t>(piece) * together;
                     for (std::size_t i = begin; i < std::min(begin + together, faces.count()); ++i)
                         faces.add(i, found);
                     const std::lock_guard lock(mutex);
                     for (std::size_t i = 0; i < pixels.size(); ++i) sums[i] += found[i];
                 });
    return sums;
}

/// Whether all faces of all volumes are drawn and counted behind the surface, but for what the near
/// plane clips.
bool counts_closed_volumes(const CountedClaim& judged) {
    const Counting& counting = judged.counting();
    return counting.test == Counting::Test::depth_fail && counting.light_cap && counting.dark_cap &&
           counting.operation == Counting::Operation::wrap && counting.casters.empty() &&
           !judged.frame.depth_model.clips_at_far();
}

} // namespace

StepSums& StepSums::operator+=(const StepSums& other) {
    low += other.low;
    high += other.high;
    up += other.up;
    return *this;
}

bool CoarseCount::may_hold(std::uint32_t read, const Counting& counting) const {
    const std::int64_t values = std::int64_t{1} << counting.bits;
    if (counting.operation == Counting::Operation::saturate) {
        // Where a step down stops at 0, what follows is more than the sum, up to all steps up; only
        // where these reach the highest value may it be less.
        if (counter.up >= values) return true;
        return read >= counter.low && read <= counter.up;
    }
    const std::int64_t last = std::min(counter.high, counter.low + values - 1);
    for (std::int64_t count = counter.low; count <= last; ++count)
        if (stored(count, counting) == read) return true;
    return false;
}

Finding finding_by_all_faces(const CountedClaim& judged, PixelPlace p, const CoarseCount& count,
                             const Finding& so_far) {
    const std::uint32_t read = judged.read_back(p);
    const std::uint32_t shown = judged.frame.triangle.at(p.x, p.y);
    const bool is_displaced =
        count.is_coarse && count.may_be_seen && count.may_hold(read, judged.counting());
    if (!is_displaced && !so_far.evidence_in_band) return so_far;
    const Visibility claim = judged.frame.claim.at(p.x, p.y);
    const Image<std::uint8_t>& cones = judged.truth().in_cone;
    const bool in_cone = cones.pixels.empty() || cones.at(p.x, p.y) != 0;
    // Without a displaced face, this is no explanation: it was looked for already.
    if (claim_of(judged, read, shown, in_cone) == claim)
        return is_displaced ? Finding{true, {Cause::precision, {}}} : so_far;
    // Of a displaced surface nobody knows which point is shown.
    const bool is_anywhere = is_displaced && !judged.surface_as_true(p) && !cones.pixels.empty();
    const auto follows_from = [&](std::uint32_t triangle) {
        if (triangle == no_triangle) return claim == Visibility::background;
        const ConeSides cone = is_anywhere
                                   ? ConeSides{true, true}
                                   : cone_sides(judged.traced.scene(), judged.frame.depth_model,
                                                judged.traced.far(), triangle, p.x, p.y);
        return (cone.inside && claim_of(judged, read, triangle, true) == claim) ||
               (cone.outside && claim_of(judged, read, triangle, false) == claim);
    };
    if (follows_from(shown) || std::ranges::any_of(count.tied, follows_from))
        return {true, {Cause::precision, {}}};
    return so_far;
}

// Volumes are closed, and triangles that share an edge meet without a gap wherever their corners
// are drawn, also where they are clipped: the faces at a pixel add up to as much as the near plane
// cut off. So what is counted behind the surface follows from what lies in front of it as well.
std::vector<CoarseCount> coarse_counts(const CountedClaim& judged,
                                       std::span<const PixelPlace> places,
                                       std::span<const double> reach) {
    std::vector<ShownPixel> pixels;
    for (std::size_t i = 0; i < places.size(); ++i)
        pixels.push_back(
            shown_pixel(judged.frame, judged.traced.far(), places[i].x, places[i].y, reach[i]));
    const std::vector<SurfaceChance> surfaces =
        surface_chances(judged.tracer(), judged.frame, pixels);
    const std::vector<FaceSums> sums = face_sums(judged, pixels);
    const ShadowDepths& depths = judged.prediction.depths();
    // Where the counter begins with what is drawn in the near plane, that is among the faces.
    const std::int64_t start = judged.counting().start == Counting::Start::eye ? depths.at_eye : 0;
    const bool is_closed = counts_closed_volumes(judged);
    const bool starts_with_caps =
        judged.frame.depth_model.parallel && std::isinf(judged.counting().extrusion) &&
        tally_of_dark_caps(judged.counting(), judged.frame.depth_model) == Tally::counted;
    std::vector<CoarseCount> counts;
    for (std::size_t i = 0; i < places.size(); ++i) {
        CoarseCount& count = counts.emplace_back();
        count.is_coarse = surfaces[i].is_coarse || sums[i].is_coarse;
        count.may_be_seen = surfaces[i].may_be_seen;
        count.tied = surfaces[i].tied;
        count.counter = {start, start, start};
        if (starts_with_caps) {
            // Of all casters, or of those that are counted behind the surface.
            const std::int64_t caps = depths.at_infinity.at(places[i].x, places[i].y);
            count.counter += {judged.counting().casters.empty() ? caps : 0, caps, caps};
        }
        count.counter += sums[i].counted;
        if (!is_closed) continue;
        const std::int64_t before = judged.frame.depth_model.clamp
                                        ? depths.at_eye
                                        : depths.at_near.at(places[i].x, places[i].y);
        count.counter.low = std::max(count.counter.low, before + sums[i].in_front.low);
        count.counter.high = std::min(count.counter.high, before + sums[i].in_front.high);
    }
    return counts;
}

} // namespace shadowproof
