#include "compare/stencil/pixel_faces.h"

#include "compare/driver/coarse_outlines.h"
#include "compare/driver/error_bounds.h"
#include "compare/driver/mask_errors.h"
#include "reference/predict/tally.h"
#include "reference/trace/faces.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace shadowproof {

PixelFaces::PixelFaces(const Tracer& tracer, const PixelVolumes& volumes, const Frame& frame,
                       double far, std::uint32_t shown, const Neighbourhood& around,
                       std::span<const RayTruth> truth)
    : tracer_(tracer), volumes_(volumes), scene_(tracer.scene()), frame_(frame), far_(far),
      shown_(shown), around_(around),
      depths_(tracer.scene(), {volumes.casters, volumes.far_ends}, frame, far, around) {
    shown_range_ = shown == no_triangle ? depths_.background() : depths_.surface(shown);
    may_cover_ =
        shown == no_triangle || (may_cover(scene_, shown, around.rays.front(), spread(around)) &&
                                 may_stand(tracer, frame.depth_model, far, around, shown));
    std::vector<std::uint32_t> in_front;
    for (const RayTruth& t : truth)
        if (t.triangle != no_triangle && t.triangle != shown && certainly_in_front(t.triangle))
            in_front.push_back(t.triangle);
    // What is hidden behind the first one closes a gap as well.
    may_gape_ = shadowproof::may_gape(scene_, in_front, around.rays) &&
                shadowproof::may_gape(scene_, all_in_front(), around.rays);
    may_be_seen_ = may_gape_ ||
                   (!in_front.empty() && are_displaced(in_front) && are_displaced(all_in_front()));
    starts_ = possible_starts();
}

bool PixelFaces::take(std::size_t ray, std::span<const RayTruth> truth, Sample& sample) const {
    const glm::dvec3& line = around_.rays[ray];
    const SeenRange planes = around_.planes_of(scene_.camera, ray);
    const bool is_moved = around_.is_moved(ray);
    if (is_moved && truth[ray].triangle != shown_ && !lies_within(planes, line)) return false;
    if (!take(line, truth[ray], planes.near, sample)) return false;
    sample.by_planes = sample.by_planes || is_moved;
    sample.moved = sample.moved || sample.by_planes;
    return true;
}

/// Whether the planes leave what is shown on a line of sight.
bool PixelFaces::lies_within(const SeenRange& planes, const glm::dvec3& line) const {
    if (shown_ == no_triangle) return false;
    const double depth = plane_depth(scene_, shown_, line);
    return depth >= planes.near && depth <= planes.far;
}

bool PixelFaces::take(const glm::dvec3& line, const RayTruth& truth, double near,
                      Sample& sample) const {
    bool moved = false;
    const std::optional<double> depth = shown_depth(truth, line, moved);
    if (!depth) return false;
    sample.line = line;
    sample.depth = *depth;
    sample.near = near;
    sample.in_cone = truth.in_cone;
    sample.ideal = ideal_depth(sample, sample.crossings);
    // The light reaches the point, exactly: no light-facing triangle lies between both. Where the
    // crossings' doubles have one there, it is as near the surface as doubles can tell. A triangle
    // that fills a hole may lie there all the same.
    const bool has_holes_filled = volumes_.casters.triangles.size() > scene_.triangles.size();
    const bool misordered = !has_holes_filled && truth.triangle == shown_ &&
                            truth.visibility == Visibility::lit && sample.ideal != 0;
    sample.by_planes = shown_ != no_triangle && truth.triangle != shown_ &&
                       (*depth < near || *depth > scene_.camera.far);
    sample.moved = moved || misordered || sample.by_planes;
    volumes_.counted.crossings(line, sample.crossings);
    return true;
}

bool PixelFaces::certainly_in_front(std::uint32_t triangle) const {
    return depths_.surface(triangle).upper < shown_range_.lower;
}

/// Whether the clipper's errors may displace each of them off the pixel.
bool PixelFaces::are_displaced(const std::vector<std::uint32_t>& triangles) const {
    const CoveredPixel pixel = depths_.covered_pixel();
    return std::ranges::all_of(triangles, [&](std::uint32_t triangle) {
        return may_be_displaced(scene_, triangle, pixel);
    });
}

/// Whether the clipper's errors may displace a light cap off the pixel. It is drawn as its triangle
/// is, from the same corners: one that may be as deep as what is shown is that surface's own, or
/// shares an edge with it, and then one of their caps is drawn. Fillings of holes are small.
bool PixelFaces::is_displaced_cap(const Crossing& crossing, const DepthRange& range) const {
    return crossing.part == Crossing::Part::light_cap && range.lower > shown_range_.upper &&
           crossing.triangle < scene_.triangles.size() &&
           may_be_displaced(scene_, crossing.triangle, depths_.covered_pixel());
}

/// All triangles that are drawn on some ray and are certainly in front of what is shown.
std::vector<std::uint32_t> PixelFaces::all_in_front() const {
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
/// there: it is what the sample sees, or it may cover the pixel and what the sample sees may come
/// out behind it or leave a gap.
std::optional<double> PixelFaces::shown_depth(const RayTruth& truth, const glm::dvec3& line,
                                              bool& moved) const {
    if (truth.triangle == shown_) return shown_ == no_triangle ? shown_range_.nominal : truth.depth;
    if (!may_cover_) return std::nullopt;
    const double depth =
        shown_ == no_triangle ? shown_range_.nominal : plane_depth(scene_, shown_, line);
    if (truth.triangle == no_triangle) return depth;
    // Without area it has no plane; its line passes the pixel where the sample's surface is.
    if (shown_ != no_triangle && std::isnan(depth_on_triangle(scene_, shown_, line))) {
        moved = true;
        return truth.depth;
    }
    if (!may_be_seen_ && certainly_in_front(truth.triangle)) return std::nullopt;
    moved = truth.depth < depth;
    return depth;
}

std::int64_t PixelFaces::flat_volumes_around(const Sample& sample) const {
    return std::ranges::count_if(volumes_.flat,
                                 [&](const FlatVolume& flat) { return may_lie_in(flat, sample); });
}

/// Whether the shown surface may come out among the faces of a flat volume: as near its plane as
/// the volume's thickness, the error of depths and the lateral error allow.
bool PixelFaces::may_lie_in(const FlatVolume& flat, const Sample& sample) const {
    if (!flat.faces_light || !std::isfinite(sample.depth)) return false;
    const Camera& camera = scene_.camera;
    const glm::dvec3 point = point_on(camera, sample.line, sample.depth);
    const double error = depth_error(scene_, frame_.depth_model, point);
    double sideways = 0;
    for (const glm::dvec3& corner : around_.corners)
        sideways = std::max(
            sideways,
            std::abs(glm::dot(flat.normal, point_on(camera, corner, sample.depth) - point)));
    return std::abs(glm::dot(flat.normal, point - flat.corner)) <=
           flat.thickness + sideways +
               error * std::abs(glm::dot(flat.normal, direction_of(camera, sample.line)));
}

/// A light cap covers what its own surface covers, at the same depth bit for bit: it is in front of
/// the visible surface only where that surface is culled, or past the far plane.
bool PixelFaces::is_never_in_front(const Crossing& crossing) const {
    if (crossing.part != Crossing::Part::light_cap) return false;
    if (crossing.triangle == shown_) return true;
    if (crossing.depth >= depths_.clip_depth(far_, -1)) return false;
    if (frame_.depth_model.clamp && crossing.depth <= depths_.clip_depth(scene_.camera.near, 1))
        return false; // which is not drawn as a surface either
    return is_drawn_as_surface(crossing);
}

/// A triangle that fills a hole is not drawn as a surface; nor is one in the holes of its mask.
bool PixelFaces::is_drawn_as_surface(const Crossing& crossing) const {
    return crossing.part == Crossing::Part::light_cap &&
           crossing.triangle < scene_.triangles.size() && !has_mask(scene_, crossing.triangle) &&
           sides_of(tracer_, crossing.triangle).visible;
}

/// Whether a face lies in front of the shown surface if no depth is rounded. One whose triangle
/// lies exactly in the surface's plane does not, whatever doubles make of it.
bool PixelFaces::is_nominally_in_front(const Crossing& crossing, const Sample& sample) const {
    if (crossing.depth >= sample.depth) return false;
    if (crossing.part != Crossing::Part::light_cap || shown_ == no_triangle) return true;
    for (int k = 0; k < 3; ++k)
        if (side(scene_, shown_, {corner(volumes_.casters, crossing.triangle, k), 1}) != 0)
            return true;
    return false;
}

/// Shadow depth of the sample's shown surface in the casters' own volumes. `crossings`: memory for
/// those along its ray. A light cap before the near plane is in front, as its surface is not seen.
std::int64_t PixelFaces::ideal_depth(const Sample& sample, std::vector<Crossing>& crossings) const {
    RegionLedger& ledger = volumes_.ideal != nullptr ? *volumes_.ideal : volumes_.counted;
    ledger.crossings(sample.line, crossings);
    std::int64_t s = volumes_.ideal_at_eye;
    if (volumes_.masked != nullptr) s -= volumes_.masked->ideal_let_through(sample.line, shown_);
    for (const Crossing& crossing : crossings) {
        const bool before_near = crossing.depth < sample.near;
        if (is_nominally_in_front(crossing, sample) &&
            (before_near || !is_never_in_front(crossing)))
            s += crossing.change;
    }
    return s;
}

std::int32_t PixelFaces::depth_at_near(const std::vector<Crossing>& crossings, int move) const {
    const double near = depths_.clip_depth(scene_.camera.near, move);
    std::int32_t s = volumes_.counted_at_eye;
    for (const Crossing& crossing : crossings)
        if (crossing.depth < near) s += crossing.change;
    return s;
}

std::int32_t PixelFaces::depth_at_near(const Sample& sample) const {
    return depth_at_near(sample.crossings, 0);
}

/// The near plane's own count is drawn, too, and may be that of any point of the neighbourhood.
std::vector<std::int32_t> PixelFaces::possible_starts() const {
    if (counting().start != Counting::Start::near_plane)
        return {start_of(counting(), volumes_.counted_at_eye, 0)};
    std::vector<std::int32_t> all;
    std::vector<Crossing> crossings;
    for (const glm::dvec3& line : around_.rays) {
        volumes_.counted.crossings(line, crossings);
        for (const int move : {0, -1, 1}) {
            const std::int32_t start = depth_at_near(crossings, move);
            if (std::find(all.begin(), all.end(), start) == all.end()) all.push_back(start);
        }
    }
    return all;
}

std::array<ClipDepths, 3> PixelFaces::clip_depths() const {
    const bool clips = std::isfinite(depths_.clip_far());
    const auto moved = [&](double depth, int by) {
        return clips ? depths_.clip_depth(depth, by) : std::numeric_limits<double>::infinity();
    };
    const ClipDepths own{scene_.camera.near, moved(far_, -1), moved(far_, 0), moved(far_, 1)};
    std::array<ClipDepths, 3> all{own, own, own};
    for (const int k : {1, 2}) {
        const int move = k == 1 ? -1 : 1;
        ClipDepths& clip = all[static_cast<std::size_t>(k)];
        clip.near = depths_.clip_depth(scene_.camera.near, move);
        clip.nearest_far = clip.far = clip.furthest_far = moved(far_, move);
        clip.moved = true;
    }
    return all;
}

std::vector<CandidateFace> PixelFaces::candidates(const Sample& sample,
                                                  const ClipDepths& clip) const {
    std::vector<CandidateFace> found;
    for (const Crossing& crossing : sample.crossings) {
        const Counting::Caster caster = counting().caster(crossing.triangle);
        const bool pass = caster.test == Counting::Test::depth_pass;
        if (crossing.part == Crossing::Part::light_cap && !caster.light_cap) continue;
        if (crossing.part == Crossing::Part::dark_cap && !caster.dark_cap) continue;
        // A surface's own cap is cut where the surface is.
        const double near = is_drawn_as_surface(crossing) ? sample.near : clip.near;
        if (!frame_.depth_model.clamp && crossing.depth < near) continue;
        if (!pass && crossing.depth >= clip.furthest_far) continue;
        const bool is_cut = !pass && crossing.depth >= clip.far;
        const bool maybe_cut = !pass && crossing.depth >= clip.nearest_far;
        const bool behind = is_never_in_front(crossing);
        const DepthRange range = depths_.face(crossing, sample.line);
        // What is seen through a gap between surfaces is seen through the same gap between their
        // caps.
        if (behind && crossing.triangle != shown_ && range.upper < shown_range_.lower) continue;
        const bool maybe_front = !behind && range.lower <= shown_range_.upper;
        const bool maybe_behind = behind || range.upper >= shown_range_.lower;
        if (!(pass ? maybe_front : maybe_behind)) continue;
        const bool in_front = !behind && is_nominally_in_front(crossing, sample);
        const bool certain =
            !(maybe_front && maybe_behind) && !maybe_cut && !is_displaced_cap(crossing, range);
        found.push_back({crossing, in_front == pass && !is_cut, certain});
    }
    return found;
}

// In front of a surface that is shown a cap stands only where its own surface does not.
std::int64_t PixelFaces::cut_with_surfaces(const Sample& sample) const {
    const double near = scene_.camera.near;
    std::int64_t sum = 0;
    if (sample.near == near) return sum;
    for (const Crossing& crossing : sample.crossings) {
        const Counting::Caster caster = counting().caster(crossing.triangle);
        if (caster.test != Counting::Test::depth_pass || !caster.light_cap ||
            !is_drawn_as_surface(crossing))
            continue;
        const bool is_cut = crossing.depth < sample.near;
        if (is_cut != (crossing.depth < near)) sum += is_cut ? -crossing.change : crossing.change;
    }
    return sum;
}

std::int64_t PixelFaces::dark_caps(const Sample& sample) const {
    if (tally_of_dark_caps(counting(), frame_.depth_model) != Tally::counted) return 0;
    return dark_caps_at_infinity(counting(), volumes_.counted_at_eye, sample.crossings);
}

// A closed volume's faces sum to 0 at every pixel, wherever its corners are snapped to. Where a cap
// is a sliver, it is entered (+1) and the others there are left (-1), or, flipped, the other way
// round. Its surface is seen there, and hides the others, unless it is culled, as it is flipped, or
// comes out behind what is shown, as depths of slivers may. What is counted then is the one or the
// other, as they lie on the one or the other side of what is shown.
StepRange PixelFaces::steps_of_slivers() const {
    const CoveredPixel pixel = depths_.covered_pixel();
    StepRange steps;
    for (const std::uint32_t triangle : volumes_.counted.light_caps()) {
        if (triangle >= scene_.triangles.size() || triangle == shown_ ||
            !may_be_flipped(scene_, triangle, pixel))
            continue;
        const Counting::Caster caster = counting().caster(triangle);
        const DepthRange range = depths_.surface(triangle);
        const bool maybe_behind = range.upper >= shown_range_.lower;
        const bool maybe_culled =
            range.lower <= shown_range_.upper &&
            !scene_.materials[scene_.meshes[mesh_of(scene_, triangle)].material].double_sided;
        if (!maybe_behind && !maybe_culled) continue;
        const bool counts_others = caster.test == Counting::Test::depth_pass || !caster.light_cap;
        if (maybe_behind || !counts_others) --steps.least;
        if (maybe_behind || counts_others) ++steps.most;
    }
    return steps;
}

Slivers::Number PixelFaces::slivers_of_any_depth() const {
    return volumes_.slivers != nullptr ? volumes_.slivers->at(depths_.covered_pixel())
                                       : Slivers::Number{};
}

} // namespace shadowproof
