#include "compare/driver/coarse_outlines.h"
#include "compare/driver/cone_side.h"
#include "compare/driver/error_bounds.h"
#include "compare/driver/mask_errors.h"
#include "compare/driver/setup_error.h"
#include "compare/driver/shown_pixel.h"
#include "compare/judge/judge.h"
#include "compare/maps/map_account.h"
#include "compare/maps/map_cause.h"
#include "compare/maps/map_centres.h"
#include "compare/maps/map_claim.h"
#include "compare/maps/map_memory.h"
#include "compare/maps/map_report.h"
#include "compare/maps/map_results.h"
#include "reference/parallel.h"
#include "reference/trace/faces.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace shadowproof {

namespace {

class MapJudge final : public Judge {
public:
    MapJudge(const TracedScene& traced, const Frame& frame)
        : claim_{traced, frame},
          view_(light_view(traced.scene(), *frame.mapped, frame.depth_model.subpixel_bits,
                           traced.tracer().threads())),
          light_(*view_), centres_(claim_, light_) {}

    std::string_view evidence() const override { return "map"; }

    bool settles(PixelPlace p, std::optional<PixelCause>& cause) const override {
        return centres_.settles(p, cause);
    }

    std::vector<BandRadius> radii(std::span<const PixelPlace> places) const override {
        std::vector<BandRadius> radii;
        for (const PixelPlace& p : places) {
            const double error = lateral(centres_.line_at(p), depth_at(p));
            radii.push_back({error, error});
        }
        return radii;
    }

    void look_around(const Region& region, std::span<const Neighbourhood> around,
                     std::span<const RayTruth> truths) const override {
        for (std::size_t i = 0; i < region.places.size(); ++i) {
            const std::span<const RayTruth> truth = truths.first(around[i].rays.size());
            truths = truths.subspan(truth.size());
            region.findings[i] = look_around(region.places[i], around[i], truth);
        }
    }

    Finding look_around(PixelPlace p, const Neighbourhood& around,
                        std::span<const RayTruth> truth) const override {
        const Visibility claim = claim_.frame.claim.at(p.x, p.y);
        PixelCause by_map;
        Finding finding;
        finding.evidence_in_band = may_claim(p, around, truth, by_map);
        if (!claim_.differs(p)) return finding;
        const SeenAround seen = seen_around(around, truth, claim);
        if (seen.truly)
            finding.cause = {Cause::edge, {}};
        else if (seen.by_planes)
            finding.cause = {Cause::precision, {}};
        else if (finding.evidence_in_band)
            finding.cause = by_map;
        return finding;
    }

    // A surface whose corners' errors displace it is drawn where no place of it is known, and so
    // neither is the texel that is asked.
    void look_at_all_faces(std::span<const PixelPlace> places,
                           std::span<Finding> findings) const override {
        const std::vector<BandRadius> reach = radii(places);
        std::vector<ShownPixel> pixels;
        for (std::size_t i = 0; i < places.size(); ++i)
            pixels.push_back(shown_pixel(claim_.frame, claim_.traced.far(), places[i].x,
                                         places[i].y, reach[i].surface));
        const std::vector<SurfaceChance> chances =
            surface_chances(claim_.traced.tracer(), claim_.frame, pixels);
        for (std::size_t i = 0; i < places.size(); ++i)
            if (may_lie_outside_cone(places[i]) ||
                (chances[i].is_coarse && chances[i].may_be_seen && may_be_displaced_to(places[i])))
                findings[i] = {true, {Cause::precision, {}}};
    }

    CoarseOutlines coarse_outlines() const override {
        return {claim_.traced.scene(), nullptr, nullptr, drawing()};
    }

    EvidenceSummary summary(const EvidenceCheck& check,
                            const Image<std::uint8_t>& /*cause*/) const override {
        const MapFigures figures{.straddling = check.in_band,
                                 .asked = centres_.texels(),
                                 .unexplained = centres_.texels_not_shown()};
        return summary_of_map(*claim_.frame.mapped, figures, claim_.traced.scene().unit);
    }

    std::shared_ptr<const EvidenceReport> report(const Image<std::uint8_t>& cause,
                                                 const MemoryBudget& /*left*/) const override {
        std::vector<std::optional<PixelLookup>> at(cause.pixels.size());
        parallel_for(cause.height, claim_.traced.tracer().threads(), [&](int y, int) {
            for (int x = 0; x < cause.width; ++x)
                at[cause.index(x, y)] = centres_.lookup_at({x, y});
        });
        return report_map(*claim_.frame.mapped, std::move(at), cause, claim_.traced.scene().unit);
    }

    Account account(const PixelRecord& record, double unit) const override {
        return account_of_lookup(centres_.lookup_at({record.x, record.y}), light_.model(), unit);
    }

private:
    JudgedClaim claim_;
    std::unique_ptr<LightView> view_;
    const LightView& light_;
    MapCentres centres_;

    Drawing drawing() const {
        const DepthModel& model = claim_.frame.depth_model;
        return drawing_of(claim_.traced.scene(), model,
                          model.clips_at_far() ? claim_.traced.far()
                                               : std::numeric_limits<double>::infinity());
    }
    double depth_at(PixelPlace p) const {
        return std::min(claim_.traced.truth().depth.at(p.x, p.y), claim_.traced.far());
    }
    double lateral(const glm::dvec3& line, double depth) const {
        const Scene& scene = claim_.traced.scene();
        return lateral_error(scene, claim_.frame.depth_model, point_on(scene.camera, line, depth));
    }

    /// The point of a triangle's plane at the pixel as the light pass has it: interpolated over the
    /// triangle, which may be drawn aside.
    UncertainPoint drawn_point(PixelPlace p, std::uint32_t triangle) const {
        const Scene& scene = claim_.traced.scene();
        const Camera& camera = scene.camera;
        const auto at = [&](double x, double y) {
            const glm::dvec3 line = line_of_sight(camera, x, y);
            const double depth = depth_on_triangle(scene, triangle, line);
            const bool is_met = camera.is_orthographic() ? std::isfinite(depth) : depth > 0;
            return start_of(camera, line) - light_.origin() +
                   (is_met ? depth : claim_.traced.far()) * direction_of(camera, line);
        };
        // Seen nearly edge-on, the plane may be anywhere; the triangle is not.
        const glm::dvec3 centre = at(p.x + 0.5, p.y + 0.5);
        double nearest = std::numeric_limits<double>::infinity();
        double farthest = 0;
        for (int k = 0; k < 3; ++k) {
            const double depth = view_depth(camera, corner(scene, triangle, k));
            nearest = std::min(nearest, depth);
            farthest = std::max(farthest, depth);
        }
        const double on_plane = view_depth(camera, centre + light_.origin());
        const double depth = std::clamp(on_plane, nearest, farthest);
        UncertainPoint point;
        point.from_light = centre + (depth - on_plane) * direction_of(camera, centres_.line_at(p));
        const double reach = lateral(centres_.line_at(p), depth);
        for (const double x : {-reach, reach})
            for (const double y : {-reach, reach})
                point.error = glm::max(
                    point.error, glm::abs(at(p.x + 0.5 + x, p.y + 0.5 + y) - point.from_light));
        point.error += interpolated_place_error(
            scene, triangle, {centres_.line_at(p), reach, drawing()}, light_.origin());
        point.error = glm::min(point.error, glm::dvec3(1e30)); // infinity times zero is no number
        return point;
    }

    /// Whether the claim may be that of some place of a displaced surface, which is not the true
    /// one.
    bool may_be_displaced_to(PixelPlace p) const {
        const std::uint32_t triangle = claim_.frame.triangle.at(p.x, p.y);
        const Visibility claim = claim_.frame.claim.at(p.x, p.y);
        if (triangle == no_triangle || claim == Visibility::background)
            return triangle == no_triangle && claim == Visibility::background;
        return !claim_.surface_as_true(p) &&
               (claim == Visibility::shadowed ||
                sides_of(claim_.traced.tracer(), triangle).faces_light());
    }

    /// Whether the pixel shows the true surface as if it were outside a spot's cone, on whose
    /// border it lies as far as its interpolated place tells.
    bool may_lie_outside_cone(PixelPlace p) const {
        const std::uint32_t triangle = claim_.frame.triangle.at(p.x, p.y);
        return triangle != no_triangle && claim_.surface_as_true(p) &&
               claim_.frame.claim.at(p.x, p.y) == Visibility::shadowed &&
               !claim_.traced.truth().in_cone.pixels.empty() &&
               cone_sides(claim_.traced.scene(), claim_.frame.depth_model, claim_.traced.far(),
                          triangle, p.x, p.y)
                   .outside;
    }

    /// Whether the claim follows from what may be drawn at the pixel. `cause`: what it is then
    /// named, `edge` where a triangle that the pixel's surroundings show needs no map.
    bool may_claim(PixelPlace p, const Neighbourhood& around, std::span<const RayTruth> truth,
                   PixelCause& cause) const {
        const Visibility claim = claim_.frame.claim.at(p.x, p.y);
        const std::uint32_t drawn = claim_.frame.triangle.at(p.x, p.y);
        cause = {Cause::edge, {}}; // unless the map is asked
        const auto seen = [&](std::uint32_t triangle) {
            return std::any_of(truth.begin(), truth.end(),
                               [&](const RayTruth& t) { return t.triangle == triangle; });
        };
        if (drawn == no_triangle) {
            if (claim != Visibility::background) return false;
            if (seen(no_triangle) || gapes(around, truth)) return true;
            cause = {Cause::precision, {}};
            return are_displaced(p, around, truth);
        }
        const Scene& scene = claim_.traced.scene();
        if (claim == Visibility::background ||
            (!seen(drawn) && !(may_cover(scene, drawn, around.rays.front(), spread(around)) &&
                               may_stand(claim_.traced.tracer(), claim_.frame.depth_model,
                                         claim_.traced.far(), around, drawn))))
            return false;
        if (!sides_of(claim_.traced.tracer(), drawn).faces_light())
            return claim == Visibility::shadowed;
        const ConeSides cone = cone_sides_around(drawn, truth);
        if (cone.outside && claim == Visibility::shadowed) return true;
        if (!cone.inside) return false;
        if (!centres_.receives(drawn)) return claim == Visibility::lit;
        return map_may_answer(p, drawn, claim, cause);
    }

    /// Whether the clipper's errors may displace all that the pixel's surroundings see.
    bool are_displaced(PixelPlace p, const Neighbourhood& around,
                       std::span<const RayTruth> truth) const {
        const Scene& scene = claim_.traced.scene();
        const CoveredPixel pixel{centres_.line_at(p), around.reach, drawing()};
        return std::ranges::all_of(
            truth, [&](const RayTruth& t) { return may_be_displaced(scene, t.triangle, pixel); });
    }

    bool gapes(const Neighbourhood& around, std::span<const RayTruth> truth) const {
        std::vector<std::uint32_t> triangles;
        for (const RayTruth& t : truth) triangles.push_back(t.triangle);
        return may_gape(claim_.traced.scene(), std::move(triangles), around.rays);
    }

    /// Where a spot's light may be: of the rays that see the triangle, or of all where none does.
    ConeSides cone_sides_around(std::uint32_t triangle, std::span<const RayTruth> truth) const {
        ConeSides own{false, false};
        ConeSides all{false, false};
        for (const RayTruth& t : truth) {
            for (ConeSides* sides : {&own, &all})
                if (sides == &all || t.triangle == triangle)
                    (t.in_cone ? sides->inside : sides->outside) = true;
        }
        return own.inside || own.outside ? own : all;
    }

    bool map_may_answer(PixelPlace p, std::uint32_t drawn, Visibility claim,
                        PixelCause& cause) const {
        const UncertainPoint point = drawn_point(p, drawn);
        const Lookup exact = lookup(light_, point.from_light);
        if (!exact.in_map && claim == Visibility::lit) {
            cause = {Cause::range, {}};
            return true;
        }
        const auto answers_so = [&](const PossibleLookup& possible) {
            if (!lit_range(light_, possible).holds(claimed_lit(claim_, p))) return false;
            bool shown = true;
            visit_asked(light_.model(), possible.lookup,
                        [&](const Texel& texel) { shown = shown && centres_.shown_by(texel); });
            return shown;
        };
        const std::optional<PossibleLookup> found = find_possible_lookup(light_, point, answers_so);
        if (!found) return false;
        // The drawn surface may be lit where the true one is not.
        const bool falsely_lit =
            !light_reaches(light_, claim_.traced.scene(), exact, point.from_light, drawn);
        if (claim != Visibility::partly_lit && falsely_lit != (claim == Visibility::lit))
            return true;
        Lookup asked = exact;
        asked.first = found->lookup.first;
        asked.texel = own_texel(light_.model(), found->lookup, exact.texel);
        const WrongAnswer wrong{drawn, point.from_light, asked, centres_.held_by(asked.texel),
                                falsely_lit};
        cause = causes_of(light_, claim_.traced.scene(), std::span(&wrong, 1)).front();
        return true;
    }
};

std::unique_ptr<Judge> judge(const TracedScene& traced, const Frame& frame) {
    return std::make_unique<MapJudge>(traced, frame);
}

} // namespace

Family map_family() {
    return {.name = "map",
            .summary = "shadow maps, whose texels are read back",
            .judge = judge,
            .check_results = check_map_results,
            .require_memory = require_map};
}

} // namespace shadowproof
