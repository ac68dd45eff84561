#include "compare/stencil/band.h"

#include "compare/driver/coarse_outlines.h"
#include "compare/driver/error_bounds.h"
#include "compare/stencil/face_depths.h"
#include "reference/predict/tally.h"
#include "reference/trace/faces.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

namespace shadowproof {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// In order, without repetition.
void sort_out(std::vector<Reading>& readings) {
    const auto key = [](const Reading& r) {
        return std::array<std::int64_t, 5>{r.count, r.ideal, r.in_cone, r.by_rounding, r.off_ray};
    };
    std::sort(readings.begin(), readings.end(),
              [&](const Reading& a, const Reading& b) { return key(a) < key(b); });
    readings.erase(
        std::unique(readings.begin(), readings.end(),
                    [&](const Reading& a, const Reading& b) { return key(a) == key(b); }),
        readings.end());
}

/// Finds the readings of one pixel, sample by sample. A sample decides which faces cover the pixel.
/// Their depths there are those of their planes, which the lateral error changes too: by much, if a
/// face is steep.
class BandFinder {
public:
    BandFinder(const Tracer& tracer, const PixelVolumes& volumes, const Frame& frame, double far,
               std::uint32_t shown, const Neighbourhood& around, std::span<const RayTruth> truth)
        : tracer_(tracer), volumes_(volumes), scene_(tracer.scene()), frame_(frame), far_(far),
          shown_(shown), around_(around),
          depths_(tracer.scene(), {volumes.casters, volumes.far_ends}, frame, far, around) {
        shown_range_ = shown == no_triangle ? depths_.background() : depths_.surface(shown);
        may_cover_ =
            shown == no_triangle || may_cover(scene_, shown, around.rays.front(), spread(around));
        std::vector<std::uint32_t> in_front;
        for (const RayTruth& t : truth)
            if (t.triangle != no_triangle && t.triangle != shown && certainly_in_front(t.triangle))
                in_front.push_back(t.triangle);
        // What is hidden behind the first one closes a gap as well.
        may_gape_ = may_gape(scene_, in_front, around.rays) &&
                    may_gape(scene_, all_in_front(), around.rays);
        may_be_seen_ = may_gape_ || (!in_front.empty() && are_displaced(in_front) &&
                                     are_displaced(all_in_front()));
        starts_ = starts();
    }

    /// Finds what the counter may read if the pixel is covered as a sample's ray is: no readings if
    /// the shown surface cannot be seen there.
    void collect(const glm::dvec3& direction, const RayTruth& truth,
                 std::vector<Reading>& readings) {
        bool moved = false;
        const std::optional<double> depth = shown_depth(truth, direction, moved);
        if (!depth) return;
        shown_range_.nominal = *depth;
        in_cone_ = truth.in_cone;
        const std::int64_t ideal = ideal_depth(direction);
        // The light reaches the point, exactly: no light-facing triangle lies between both. Where
        // the crossings' doubles have one there, it is as near the surface as doubles can tell. A
        // triangle that fills a hole may lie there all the same.
        const bool has_holes_filled = volumes_.casters.triangles.size() > scene_.triangles.size();
        const bool misordered = !has_holes_filled && truth.triangle == shown_ &&
                                truth.visibility == Visibility::lit && ideal != 0;
        moved = moved || misordered;
        volumes_.counted.crossings(direction, crossings_);
        for (const int move : {0, -1, 1}) collect_clipped(direction, move, ideal, moved, readings);
        sort_out(readings);
        // In its plane the faces of a flat volume may come in any order, with the surface among
        // them: each one that is entered is left again, and in between the count is one more or
        // less.
        const std::int64_t most = std::ranges::count_if(volumes_.flat, [&](const FlatVolume& flat) {
            return may_lie_in(flat, direction, *depth);
        });
        move_counts(-most, most, readings);
    }

    /// Rays through all parts into which the outlines of volumes divide the neighbourhood.
    std::vector<glm::dvec3> rays_between_outlines() const {
        std::vector<glm::dvec3> planes = volumes_.counted.outlines(around_.corners);
        if (volumes_.ideal != nullptr) {
            const std::vector<glm::dvec3> more = volumes_.ideal->outlines(around_.corners);
            planes.insert(planes.end(), more.begin(), more.end());
        }
        return rays_between(around_, std::move(planes));
    }

    /// Appends the readings of all samples with sides that are seen edge-on: no sample's ray meets
    /// these, but snapping may turn them into slivers that face either way.
    void add_edge_on_sides(std::vector<Reading>& readings) const {
        sort_out(readings);
        const std::int64_t most = volumes_.counted.edge_on_sides(around_.corners);
        move_counts(-most, most, readings);
    }

    /// Appends the readings of all samples with light caps that snapping may turn over. Their
    /// surfaces are then culled, so that such a cap, which is left instead of entered, may come out
    /// in front of what is shown; its neighbours' caps reach over it, behind what is shown.
    void add_turned_caps(std::vector<Reading>& readings) const {
        const CoveredPixel pixel = depths_.covered_pixel();
        std::int64_t turned = 0;
        for (const std::uint32_t triangle : volumes_.counted.light_caps()) {
            if (triangle >= scene_.triangles.size() || triangle == shown_ ||
                !frame_.counted->counting.caster(triangle).light_cap ||
                scene_.materials[scene_.meshes[mesh_of(scene_, triangle)].material].double_sided)
                continue;
            if (may_turn_over(scene_, triangle, pixel) &&
                depths_.surface(triangle).lower <= shown_range_.upper)
                ++turned;
        }
        sort_out(readings);
        move_counts(-turned, 0, readings);
    }

    /// Appends what a counter that stops at its limits may read if each face is as in one of the
    /// samples, not all in the same one: snapping moves every corner by itself, and a step down
    /// that no single ray meets together with the following step up changes where the counter
    /// stops. The sum of the faces is that of some sample, as the volumes stay closed.
    void collect_mixed(std::span<const RayTruth> truth, std::vector<Reading>& readings) {
        std::vector<Sum> sums;
        Reading reading; // on the last ray that shows the surface
        std::map<FaceKey, Candidate> faces;
        bool first = true;
        for (std::size_t i = 0; i < around_.rays.size(); ++i) {
            const glm::dvec3& direction = around_.rays[i];
            bool moved = false;
            const std::optional<double> depth = shown_depth(truth[i], direction, moved);
            if (!depth) continue;
            shown_range_.nominal = *depth;
            const std::int64_t ideal = ideal_depth(direction);
            reading.direction = direction;
            reading.depth = *depth;
            const std::map<FaceKey, Candidate> here = faces_of_sample(direction);
            add_sums(here, ideal, truth[i].in_cone, sums);
            merge(here, first, faces);
            first = false;
        }
        std::vector<PossibleFace> possible;
        for (const auto& [key, face] : faces) possible.push_back({face.crossing, face.certain});
        for (const Sum& sum : sums)
            for (const std::int64_t count : possible_counts_of_sum(
                     possible, sum.start, sum.dark_caps, frame_.counted->counting, sum.sum))
                readings.push_back({count, sum.ideal, sum.in_cone, false, reading.direction,
                                    reading.depth, sum.off_ray});
    }

    /// Appends what may be read if the shown surface is seen through a gap, on no sample's ray. The
    /// gap lies between surfaces that move apart, so each face may be as in any of the samples, and
    /// the caps of those surfaces are not drawn.
    void collect_in_gap(std::span<const RayTruth> truth, std::vector<Reading>& readings) {
        if (!may_gape_ ||
            std::ranges::any_of(truth, [&](const RayTruth& t) { return t.triangle == shown_; }))
            return;
        std::map<FaceKey, Candidate> faces;
        std::int64_t last = 0;
        std::int64_t ideal = 0;
        Reading reading; // on the last ray that shows the surface
        bool first = true;
        for (std::size_t i = 0; i < around_.rays.size(); ++i) {
            bool moved = false;
            const std::optional<double> depth = shown_depth(truth[i], around_.rays[i], moved);
            if (!depth) continue;
            shown_range_.nominal = *depth;
            ideal = ideal_depth(around_.rays[i]);
            reading.direction = around_.rays[i];
            reading.depth = *depth;
            merge(faces_of_sample(around_.rays[i]), first, faces);
            last = dark_caps();
            first = false;
        }
        if (first) return;
        std::vector<PossibleFace> possible;
        for (const auto& [key, face] : faces) possible.push_back({face.crossing, face.certain});
        for (const std::int32_t start : starts_)
            for (const std::int64_t count :
                 possible_counts(possible, start, last, frame_.counted->counting))
                readings.push_back(
                    {count, ideal, truth[0].in_cone, true, reading.direction, reading.depth});
    }

private:
    const Tracer& tracer_;
    const PixelVolumes& volumes_;
    const Scene& scene_;
    const Frame& frame_;
    double far_;
    std::uint32_t shown_;
    const Neighbourhood& around_;
    DepthRange shown_range_;
    bool may_cover_ = false;           ///< what is shown may cover the pixel's centre
    bool may_gape_ = false;            ///< what is in front of it may let it be seen through a gap
    bool may_be_seen_ = false;         ///< that, or all of it may be drawn elsewhere
    std::vector<std::int32_t> starts_; ///< what the counter may hold before the first face
    bool in_cone_ = true;              ///< as Reading::in_cone, of the sample at hand
    std::vector<Crossing> crossings_;  ///< of the sample at hand
    FaceDepths depths_;

    bool certainly_in_front(std::uint32_t triangle) const {
        return depths_.surface(triangle).upper < shown_range_.lower;
    }

    /// Whether the clipper's errors may displace each of them off the pixel.
    bool are_displaced(const std::vector<std::uint32_t>& triangles) const {
        const CoveredPixel pixel = depths_.covered_pixel();
        return std::ranges::all_of(triangles, [&](std::uint32_t triangle) {
            return may_be_displaced(scene_, triangle, pixel);
        });
    }

    /// All triangles that are drawn on some ray and are certainly in front of what is shown.
    std::vector<std::uint32_t> all_in_front() const {
        std::vector<std::uint32_t> found;
        for (std::uint32_t triangle = 0; triangle < scene_.triangles.size(); ++triangle)
            if (triangle != shown_ && sides_of(tracer_, triangle).visible &&
                std::ranges::any_of(
                    around_.rays,
                    [&](const glm::dvec3& ray) { return may_cover(scene_, triangle, ray, 0); }) &&
                certainly_in_front(triangle))
                found.push_back(triangle);
        return found;
    }

    /// The depth of the shown surface where the pixel is covered as a sample is, if it may be seen
    /// there: it is what the sample sees, or it may cover the pixel and what the sample sees may
    /// come out behind it or leave a gap.
    std::optional<double> shown_depth(const RayTruth& truth, const glm::dvec3& direction,
                                      bool& moved) const {
        if (truth.triangle == shown_)
            return shown_ == no_triangle ? shown_range_.nominal : truth.depth;
        if (!may_cover_) return std::nullopt;
        const double depth = shown_ == no_triangle ? depths_.background().nominal
                                                   : plane_depth(scene_, shown_, direction);
        if (truth.triangle == no_triangle) return depth;
        // Without area it has no plane; its line passes the pixel where the sample's surface is.
        if (shown_ != no_triangle && std::isnan(depth_on_triangle(scene_, shown_, direction))) {
            moved = true;
            return truth.depth;
        }
        if (!may_be_seen_ && certainly_in_front(truth.triangle)) return std::nullopt;
        moved = truth.depth < depth;
        return depth;
    }

    /// Whether the shown surface, at a depth along a ray, may come out among the faces of a flat
    /// volume: as near its plane as the volume's thickness, the error of depths and the lateral
    /// error allow.
    bool may_lie_in(const FlatVolume& flat, const glm::dvec3& direction, double depth) const {
        if (!flat.faces_light || !std::isfinite(depth)) return false;
        const glm::dvec3 point = scene_.camera.eye + depth * direction;
        const double error = depth_error(scene_, frame_.depth_model, point);
        double sideways = 0;
        for (const glm::dvec3& corner : around_.corners)
            sideways =
                std::max(sideways, std::abs(glm::dot(flat.normal, corner - direction)) * depth);
        return std::abs(glm::dot(flat.normal, point - flat.corner)) <=
               flat.thickness + sideways + error * std::abs(glm::dot(flat.normal, direction));
    }

    /// A light cap covers what its own surface covers, at the same depth bit for bit: it is in
    /// front of the visible surface only where that surface is culled, or past the far plane.
    bool is_never_in_front(const Crossing& crossing) const {
        if (crossing.part != Crossing::Part::light_cap) return false;
        if (crossing.triangle == shown_) return true;
        if (crossing.depth >= depths_.clip_depth(far_, -1)) return false;
        if (frame_.depth_model.clamp && crossing.depth <= depths_.clip_depth(scene_.camera.near, 1))
            return false; // which is not drawn as a surface either
        // A triangle that fills a hole is not drawn as a surface.
        return crossing.triangle < scene_.triangles.size() &&
               sides_of(tracer_, crossing.triangle).visible;
    }

    /// Shadow depth of the shown surface in the casters' own volumes.
    std::int64_t ideal_depth(const glm::dvec3& direction) {
        RegionLedger& ledger = volumes_.ideal != nullptr ? *volumes_.ideal : volumes_.counted;
        ledger.crossings(direction, crossings_);
        std::int64_t s = volumes_.ideal_at_eye;
        for (const Crossing& crossing : crossings_)
            if (crossing.depth < shown_range_.nominal && !is_never_in_front(crossing))
                s += crossing.change;
        return s;
    }

    std::int32_t depth_at_near(const std::vector<Crossing>& crossings, int move) const {
        const double near = depths_.clip_depth(scene_.camera.near, move);
        std::int32_t s = volumes_.counted_at_eye;
        for (const Crossing& crossing : crossings)
            if (crossing.depth < near) s += crossing.change;
        return s;
    }

    /// The near plane's own count is drawn, too, and may be that of any point of the
    /// neighbourhood.
    std::vector<std::int32_t> starts() {
        const Counting& counting = frame_.counted->counting;
        if (counting.start != Counting::Start::near_plane)
            return {start_of(counting, volumes_.counted_at_eye, 0)};
        std::vector<std::int32_t> all;
        for (const glm::dvec3& direction : around_.rays) {
            volumes_.counted.crossings(direction, crossings_);
            for (const int move : {0, -1, 1}) {
                const std::int32_t start = depth_at_near(crossings_, move);
                if (std::find(all.begin(), all.end(), start) == all.end()) all.push_back(start);
            }
        }
        return all;
    }

    /// A face that may be counted at the sample, and whether that is certain.
    struct Candidate {
        Crossing crossing;
        bool nominally = false;
        bool certain = false; ///< whatever the depths are rounded to
    };

    /// Faces that are drawn, neither clipped nor on the wrong side of the surface for certain.
    std::vector<Candidate> candidates(const glm::dvec3& direction, int move) const {
        const Counting& counting = frame_.counted->counting;
        const double near = depths_.clip_depth(scene_.camera.near, move);
        const double far =
            std::isfinite(depths_.clip_far()) ? depths_.clip_depth(far_, move) : infinity;
        std::vector<Candidate> found;
        for (const Crossing& crossing : crossings_) {
            const Counting::Caster caster = counting.caster(crossing.triangle);
            const bool pass = caster.test == Counting::Test::depth_pass;
            if (crossing.part == Crossing::Part::light_cap && !caster.light_cap) continue;
            if (crossing.part == Crossing::Part::dark_cap && !caster.dark_cap) continue;
            if (!frame_.depth_model.clamp && crossing.depth < near) continue;
            if (!pass && crossing.depth >= far) continue;
            const bool behind = is_never_in_front(crossing);
            const DepthRange range = depths_.face(crossing, direction);
            // What is seen through a gap between surfaces is seen through the same gap between
            // their caps.
            if (behind && crossing.triangle != shown_ && range.upper < shown_range_.lower) continue;
            const bool maybe_front = !behind && range.lower <= shown_range_.upper;
            const bool maybe_behind = behind || range.upper >= shown_range_.lower;
            if (!(pass ? maybe_front : maybe_behind)) continue;
            const bool in_front = !behind && crossing.depth < shown_range_.nominal;
            found.push_back({crossing, in_front == pass, !(maybe_front && maybe_behind)});
        }
        return found;
    }

    std::int64_t dark_caps() const {
        if (tally_of_dark_caps(frame_.counted->counting, frame_.depth_model) != Tally::counted)
            return 0;
        return dark_caps_at_infinity(frame_.counted->counting, volumes_.counted_at_eye, crossings_);
    }

    /// Appends the readings with more or fewer faces in front of the surface.
    void move_counts(std::int64_t least, std::int64_t most, std::vector<Reading>& readings) const {
        const std::size_t unmoved = readings.size();
        for (std::int64_t by = least; by <= most; ++by)
            for (std::size_t i = 0; by != 0 && i < unmoved; ++i) {
                Reading moved = readings[i];
                moved.count = stepped(moved.count, by, frame_.counted->counting);
                moved.ideal += by;
                moved.off_ray += by;
                moved.by_rounding = true;
                readings.push_back(moved);
            }
    }

    /// Readings with the clipping planes moved.
    void collect_clipped(const glm::dvec3& direction, int move, std::int64_t ideal, bool moved,
                         std::vector<Reading>& readings) const {
        const std::vector<Candidate> faces = candidates(direction, move);
        const std::int64_t last = dark_caps();
        const std::int32_t near = depth_at_near(crossings_, 0);
        const std::int32_t start =
            start_of(frame_.counted->counting, volumes_.counted_at_eye, near);
        // A reading off the nominal one by faces in front or behind moves the ideal one with it.
        const CountOfSum nominal = nominal_count(faces, start, last);
        const auto add = [&](const CountOfSum& found) {
            const std::int64_t off = found.sum - nominal.sum;
            const bool rounded = moved || move != 0 || found != nominal;
            readings.push_back({found.count, ideal + off, in_cone_, rounded, direction,
                                shown_range_.nominal, off});
        };
        if (move == 0) add(nominal);
        for (const std::int32_t other : starts_)
            for (const CountOfSum& found : counts_with_uncertain(faces, other, last)) add(found);
    }

    /// A face as samples share it.
    using FaceKey = std::tuple<Crossing::Part, std::uint32_t, std::uint32_t, int>;
    static FaceKey key_of(const Crossing& face) {
        return {face.part, face.triangle, face.is_side() ? face.edge : 0, face.change};
    }

    /// The faces that a sample's ray crosses and that may be counted there.
    std::map<FaceKey, Candidate> faces_of_sample(const glm::dvec3& direction) {
        volumes_.counted.crossings(direction, crossings_);
        std::map<FaceKey, Candidate> faces;
        for (const Candidate& face : candidates(direction, 0)) {
            if (face.certain && !face.nominally) continue;
            const auto [same, is_new] = faces.emplace(key_of(face.crossing), face);
            if (!is_new) same->second.crossing.change += face.crossing.change;
        }
        return faces;
    }

    /// The sum of one sample's faces, none of them lost at a limit.
    struct Sum {
        std::int64_t start = 0;
        std::int64_t dark_caps = 0;
        std::int64_t sum = 0;
        std::int64_t ideal = 0;
        std::int64_t off_ray = 0;
        bool in_cone = true;
        friend bool operator==(const Sum&, const Sum&) = default;
    };

    void add_sums(const std::map<FaceKey, Candidate>& faces, std::int64_t ideal, bool in_cone,
                  std::vector<Sum>& sums) const {
        std::vector<PossibleFace> possible;
        std::int64_t nominal = 0;
        for (const auto& [key, face] : faces) {
            possible.push_back({face.crossing, face.certain});
            if (face.nominally)
                nominal += weight(frame_.counted->counting, face.crossing) * face.crossing.change;
        }
        Counting unlimited = frame_.counted->counting;
        unlimited.operation = Counting::Operation::wrap;
        const std::int64_t last = dark_caps();
        for (const std::int32_t start : starts_)
            for (const std::int64_t sum : possible_counts(possible, start, last, unlimited)) {
                const std::int64_t off = sum - nominal - start - last;
                const Sum found{start, last, sum, ideal + off, off, in_cone};
                if (std::find(sums.begin(), sums.end(), found) == sums.end()) sums.push_back(found);
            }
    }

    /// A face is certain if it is certain in every sample.
    static void merge(const std::map<FaceKey, Candidate>& here, bool first,
                      std::map<FaceKey, Candidate>& faces) {
        for (auto& [key, face] : faces) {
            const auto same = here.find(key);
            face.certain = face.certain && same != here.end() && same->second.certain;
        }
        for (const auto& [key, face] : here) {
            const bool is_new = faces.emplace(key, face).second;
            if (is_new && !first) faces.at(key).certain = false;
        }
    }

    CountOfSum nominal_count(const std::vector<Candidate>& faces, std::int64_t start,
                             std::int64_t last) const {
        std::vector<PossibleFace> drawn;
        for (const Candidate& face : faces)
            if (face.nominally) drawn.push_back({face.crossing, true});
        return possible_sums(std::move(drawn), start, last, frame_.counted->counting).front();
    }

    /// All values that the counter may have with uncertain faces counted or not.
    std::vector<CountOfSum> counts_with_uncertain(const std::vector<Candidate>& faces,
                                                  std::int64_t start, std::int64_t last) const {
        std::vector<PossibleFace> possible;
        for (const Candidate& face : faces)
            if (!face.certain || face.nominally) possible.push_back({face.crossing, face.certain});
        return possible_sums(std::move(possible), start, last, frame_.counted->counting);
    }
};

} // namespace

PixelBand find_band(const Tracer& tracer, const PixelVolumes& volumes, const Frame& frame,
                    double far, std::uint32_t shown, const Neighbourhood& around,
                    std::span<const RayTruth> truth,
                    const std::function<bool(const Reading&)>& matches) {
    BandFinder finder(tracer, volumes, frame, far, shown, around, truth);
    PixelBand band;
    bool found = false;
    const auto look_along = [&](std::span<const glm::dvec3> rays,
                                std::span<const RayTruth> truth_there) {
        for (std::size_t i = 0; i < rays.size() && !found; ++i) {
            std::vector<Reading> readings;
            finder.collect(rays[i], truth_there[i], readings);
            found = std::any_of(readings.begin(), readings.end(), matches);
            band.readings.insert(band.readings.end(), readings.begin(), readings.end());
        }
    };
    look_along(around.rays, truth);
    const bool may_mix = around.rays.size() > 1;
    if (!found && may_mix) {
        const std::vector<glm::dvec3> rays = finder.rays_between_outlines();
        std::vector<RayTruth> truth_there;
        for (const glm::dvec3& ray : rays) truth_there.push_back(trace_ray(tracer, ray));
        look_along(rays, truth_there);
    }
    if (!found && may_mix && frame.counted->counting.operation == Counting::Operation::saturate)
        finder.collect_mixed(truth, band.readings);
    if (!found && may_mix) finder.collect_in_gap(truth, band.readings);
    if (!found && may_mix) finder.add_edge_on_sides(band.readings);
    if (!found && may_mix) finder.add_turned_caps(band.readings);
    sort_out(band.readings);
    return band;
}

} // namespace shadowproof
