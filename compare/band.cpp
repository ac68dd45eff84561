#include "compare/band.h"

#include "compare/freedom.h"
#include "compare/setup_freedom.h"
#include "reference/tally.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <unordered_map>

namespace shadowproof {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Depth at which a ray meets a triangle's plane; infinite where that is behind the eye.
double plane_depth(const Scene& scene, std::uint32_t triangle, const glm::dvec3& direction) {
    const glm::dvec3 a = corner(scene, triangle, 0);
    const glm::dvec3 normal =
        glm::cross(corner(scene, triangle, 1) - a, corner(scene, triangle, 2) - a);
    const double depth = glm::dot(a - scene.camera.eye, normal) / glm::dot(direction, normal);
    return depth > 0 ? depth : infinity;
}

/// The range of view depths that the rasterizer may give to a face.
struct DepthRange {
    double nominal = 0; ///< on the sample's own ray
    double lower = 0;
    double upper = 0;

    void include(double depth, double freedom) {
        lower = std::min(lower, depth - freedom);
        upper = std::max(upper, depth + freedom);
    }
};

/// Finds the readings of one pixel, sample by sample. Which faces cover the pixel is what a sample
/// decides; their depths there are those of their planes, which the sideways freedom moves too: by
/// much, where a face is steep.
class BandFinder {
public:
    BandFinder(const Tracer& tracer, const PixelVolumes& volumes, const Frame& frame, double far,
               std::uint32_t shown, const Neighbourhood& around, std::span<const RayTruth> truth)
        : tracer_(tracer), volumes_(volumes), scene_(tracer.scene()), frame_(frame), far_(far),
          shown_(shown), around_(around) {
        shown_range_ = shown == no_triangle ? background_range() : surface_range(shown);
        may_cover_ =
            shown != no_triangle && may_cover(scene_, shown, around.rays.front(), spread(around));
        std::vector<std::uint32_t> in_front;
        for (const RayTruth& t : truth)
            if (t.triangle != no_triangle && t.triangle != shown && certainly_in_front(t.triangle))
                in_front.push_back(t.triangle);
        may_gape_ = may_gape(scene_, in_front);
        starts_ = starts();
    }

    /// Appends what the counter may read if the pixel is covered as sample i is: nothing where the
    /// shown surface cannot be seen there.
    void collect(std::size_t i, const RayTruth& truth, std::vector<Reading>& readings) {
        bool moved = false;
        const glm::dvec3& direction = around_.rays[i];
        const std::optional<double> depth = shown_depth(truth, direction, moved);
        if (!depth) return;
        shown_range_.nominal = *depth;
        in_cone_ = truth.in_cone;
        const std::int64_t ideal = ideal_depth(direction);
        volumes_.counted.crossings(direction, crossings_);
        for (const int move : {0, -1, 1}) collect_clipped(direction, move, ideal, moved, readings);
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
    bool may_cover_ = false;           ///< the shown triangle may cover the pixel's centre
    bool may_gape_ = false;            ///< what is in front of it may let it be seen through a gap
    std::vector<std::int32_t> starts_; ///< what the counter may hold before the first face
    bool in_cone_ = true;              ///< as Reading::in_cone, of the sample at hand
    std::vector<Crossing> crossings_;  ///< of the sample at hand
    mutable std::unordered_map<std::uint32_t, double> setup_of_side_; ///< by Crossing::edge
    mutable std::unordered_map<std::uint32_t, double> setup_of_triangle_;

    bool certainly_in_front(std::uint32_t triangle) const {
        return surface_range(triangle).upper < shown_range_.lower;
    }

    /// A triangle's plane over the neighbourhood, with the depth format's freedom.
    DepthRange surface_range(std::uint32_t triangle) const {
        DepthRange range{0, infinity, 0};
        const double setup = setup_error(triangle);
        for (const glm::dvec3& direction : around_.corners) {
            const double t = plane_depth(scene_, triangle, direction);
            const glm::dvec3 point = scene_.camera.eye + std::min(t, far_) * direction;
            const double slope_error = std::isfinite(t) ? setup * t * t : 0;
            range.include(t, depth_freedom(scene_, frame_.depth_model, point) + slope_error);
        }
        return range;
    }

    CoveredPixel covered_pixel() const {
        const double offset = frame_.depth_model.eye_relative ? 0 : glm::length(scene_.camera.eye);
        const double near = frame_.counting.depth_clamp ? 0 : scene_.camera.near;
        return {around_.rays.front(), around_.reach, near, clip_far(), offset};
    }
    /// The far plane's depth where it clips.
    double clip_far() const {
        return frame_.depth_model.finite() && !frame_.counting.depth_clamp ? far_ : infinity;
    }

    /// As setup_freedom has it, once for each edge and triangle at this pixel.
    double setup_error(const Crossing& side) const {
        const auto [known, is_new] = setup_of_side_.try_emplace(side.edge, 0.0);
        if (is_new)
            known->second =
                setup_freedom(volumes_.casters, volumes_.far_ends, side, covered_pixel());
        return known->second;
    }
    double setup_error(std::uint32_t triangle) const {
        const auto [known, is_new] = setup_of_triangle_.try_emplace(triangle, 0.0);
        if (is_new) known->second = setup_freedom(scene_, triangle, covered_pixel());
        return known->second;
    }

    /// A volume face's plane over the neighbourhood: on a ray D it is met at a depth that is
    /// inverse to D . plane; not at all where that changes its sign.
    DepthRange face_range(const Crossing& crossing, const glm::dvec3& direction) const {
        DepthRange range{crossing.depth, crossing.depth, crossing.depth};
        // Light caps that may be in front are culled surfaces, or fill holes.
        if (crossing.is_side())
            range.include(crossing.depth, setup_error(crossing) * crossing.depth * crossing.depth);
        else if (crossing.triangle < scene_.triangles.size())
            range.include(crossing.depth,
                          setup_error(crossing.triangle) * crossing.depth * crossing.depth);
        const double here = glm::dot(direction, crossing.plane);
        for (const glm::dvec3& other : around_.corners) {
            const double ratio = here / glm::dot(other, crossing.plane);
            range.include(ratio > 0 ? crossing.depth * ratio : infinity, 0);
        }
        return range;
    }

    /// The depth of the shown surface where the pixel is covered as a sample is, if it may be seen
    /// there: it is what the sample sees, or it may cover the pixel and what the sample sees may
    /// come out behind it or leave a gap.
    std::optional<double> shown_depth(const RayTruth& truth, const glm::dvec3& direction,
                                      bool& moved) const {
        if (truth.triangle == shown_)
            return shown_ == no_triangle ? shown_range_.nominal : truth.depth;
        if (!may_cover_) return std::nullopt;
        const double depth = plane_depth(scene_, shown_, direction);
        if (truth.triangle == no_triangle) return depth;
        if (!may_gape_ && certainly_in_front(truth.triangle)) return std::nullopt;
        moved = truth.depth < depth;
        return depth;
    }

    /// The cleared depth: the far plane, or infinity, where a standard projection's depths round
    /// to 1 as soon as n / t is within the error of 1.
    DepthRange background_range() const {
        const DepthModel& model = frame_.depth_model;
        if (model.projection == DepthModel::Projection::infinite_reversed)
            return {infinity, infinity, infinity};
        if (model.projection == DepthModel::Projection::infinite)
            return {infinity, model.near / depth_roundings, infinity};
        const glm::dvec3 point = scene_.camera.eye + far_ * scene_.camera.forward;
        const double q = depth_freedom(scene_, model, point);
        return {far_, far_ - q, far_ + q};
    }

    /// A light cap covers what its own surface covers, at the same depth bit for bit: it is in
    /// front of the visible surface only where that surface is culled, or past the far plane.
    bool is_never_in_front(const Crossing& crossing) const {
        if (crossing.part != Crossing::Part::light_cap) return false;
        if (crossing.triangle == shown_) return true;
        if (crossing.depth >= clip_depth(far_, -1)) return false;
        if (frame_.counting.depth_clamp && crossing.depth <= clip_depth(scene_.camera.near, 1))
            return false; // which is no surface either
        // What fills a hole is no surface.
        return crossing.triangle < scene_.triangles.size() &&
               sides_of(tracer_, crossing.triangle).visible;
    }

    /// Shadow depth at the shown surface, as the casters have it.
    std::int64_t ideal_depth(const glm::dvec3& direction) {
        RegionLedger& ledger = volumes_.ideal != nullptr ? *volumes_.ideal : volumes_.counted;
        ledger.crossings(direction, crossings_);
        std::int64_t s = volumes_.ideal_at_eye;
        for (const Crossing& crossing : crossings_)
            if (crossing.depth < shown_range_.nominal && !is_never_in_front(crossing))
                s += crossing.change;
        return s;
    }

    /// A clipping plane's depth, moved by -1, 0 or 1 times that depth's freedom: it is rounded as
    /// any.
    double clip_depth(double depth, int move) const {
        const Camera& camera = scene_.camera;
        return depth + move * depth_freedom(scene_, frame_.depth_model,
                                            camera.eye + depth * camera.forward);
    }

    std::int32_t depth_at_near(const std::vector<Crossing>& crossings, int move) const {
        const double near = clip_depth(scene_.camera.near, move);
        std::int32_t s = volumes_.counted_at_eye;
        for (const Crossing& crossing : crossings)
            if (crossing.depth < near) s += crossing.change;
        return s;
    }

    /// The near plane's own count is drawn, too, and may be that of any point of the
    /// neighbourhood.
    std::vector<std::int32_t> starts() {
        const Counting& counting = frame_.counting;
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

    /// A face that may be counted at the sample, and whether it is.
    struct Candidate {
        Crossing crossing;
        bool nominally = false;
        bool certain = false; ///< wherever depths come out
    };

    /// Faces that are drawn, neither clipped nor on the wrong side of the surface for certain.
    std::vector<Candidate> candidates(const glm::dvec3& direction, int move) const {
        const Counting& counting = frame_.counting;
        const double near = clip_depth(scene_.camera.near, move);
        const double far = std::isfinite(clip_far()) ? clip_depth(far_, move) : infinity;
        std::vector<Candidate> found;
        for (const Crossing& crossing : crossings_) {
            const Counting::Caster caster = counting.caster(crossing.triangle);
            const bool pass = caster.test == Counting::Test::depth_pass;
            if (crossing.part == Crossing::Part::light_cap && !caster.light_cap) continue;
            if (crossing.part == Crossing::Part::dark_cap && !caster.dark_cap) continue;
            if (!counting.depth_clamp && crossing.depth < near) continue;
            if (!pass && crossing.depth >= far) continue;
            const bool behind = is_never_in_front(crossing);
            const DepthRange range = face_range(crossing, direction);
            const bool maybe_front = !behind && range.lower <= shown_range_.upper;
            const bool maybe_behind = behind || range.upper >= shown_range_.lower;
            if (!(pass ? maybe_front : maybe_behind)) continue;
            const bool in_front = !behind && crossing.depth < shown_range_.nominal;
            found.push_back({crossing, in_front == pass, !(maybe_front && maybe_behind)});
        }
        return found;
    }

    std::int64_t dark_caps() const {
        if (tally_of_dark_caps(frame_.counting, frame_.depth_model) != Tally::counted) return 0;
        return dark_caps_at_infinity(frame_.counting, volumes_.counted_at_eye, crossings_);
    }

    /// Readings with the clipping planes moved.
    void collect_clipped(const glm::dvec3& direction, int move, std::int64_t ideal, bool moved,
                         std::vector<Reading>& readings) const {
        const std::vector<Candidate> faces = candidates(direction, move);
        const std::int64_t last = dark_caps();
        const std::int32_t near = depth_at_near(crossings_, 0);
        const std::int32_t start = start_of(frame_.counting, volumes_.counted_at_eye, near);
        // A reading off the nominal one by faces in front or behind moves the ideal one with it.
        const std::int64_t nominal = nominal_count(faces, start, last);
        const auto add = [&](std::int64_t count, bool shifted) {
            readings.push_back({count, shifted ? ideal + count - nominal : ideal,
                                volumes_.ideal_at_eye, in_cone_, moved || move != 0 || shifted});
        };
        if (move == 0) add(nominal, false);
        for (const std::int32_t other : starts_)
            for (const std::int64_t count : counts_with_uncertain(faces, other, last))
                add(count, count != nominal);
    }

    std::int64_t nominal_count(const std::vector<Candidate>& faces, std::int64_t start,
                               std::int64_t last) const {
        std::vector<Crossing> drawn;
        for (const Candidate& face : faces)
            if (face.nominally) drawn.push_back(face.crossing);
        return counted_in_order(drawn, start, last, frame_.counting);
    }

    /// All values that the counter may have with uncertain faces counted or not.
    std::vector<std::int64_t> counts_with_uncertain(const std::vector<Candidate>& faces,
                                                    std::int64_t start, std::int64_t last) const {
        std::vector<PossibleFace> possible;
        for (const Candidate& face : faces)
            if (!face.certain || face.nominally) possible.push_back({face.crossing, face.certain});
        return possible_counts(std::move(possible), start, last, frame_.counting);
    }
};

void sort_out(std::vector<Reading>& readings) {
    const auto key = [](const Reading& r) {
        return std::array<std::int64_t, 5>{r.count, r.ideal, r.at_eye, r.in_cone, r.moved_in_depth};
    };
    std::sort(readings.begin(), readings.end(),
              [&](const Reading& a, const Reading& b) { return key(a) < key(b); });
    readings.erase(
        std::unique(readings.begin(), readings.end(),
                    [&](const Reading& a, const Reading& b) { return key(a) == key(b); }),
        readings.end());
}

} // namespace

PixelBand find_band(const Tracer& tracer, const PixelVolumes& volumes, const Frame& frame,
                    double far, std::uint32_t shown, const Neighbourhood& around,
                    std::span<const RayTruth> truth,
                    const std::function<bool(const Reading&)>& matches) {
    BandFinder finder(tracer, volumes, frame, far, shown, around, truth);
    PixelBand band;
    for (std::size_t i = 0; i < around.rays.size(); ++i) {
        std::vector<Reading> readings;
        finder.collect(i, truth[i], readings);
        const bool found = std::any_of(readings.begin(), readings.end(), matches);
        band.readings.insert(band.readings.end(), readings.begin(), readings.end());
        if (found) break;
    }
    sort_out(band.readings);
    return band;
}

} // namespace shadowproof
