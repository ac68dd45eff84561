#include "compare/driver/coarse_outlines.h"
#include "compare/driver/cone_side.h"
#include "compare/driver/error_bounds.h"
#include "compare/driver/setup_error.h"
#include "compare/driver/shown_pixel.h"
#include "compare/judge/judge.h"
#include "compare/maps/footprint.h"
#include "compare/maps/map_account.h"
#include "compare/maps/map_cause.h"
#include "compare/maps/map_claim.h"
#include "compare/maps/map_memory.h"
#include "compare/maps/map_report.h"
#include "compare/maps/map_results.h"
#include "compare/maps/texel_set.h"
#include "reference/parallel.h"
#include "reference/trace/faces.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace shadowproof {

namespace {

/// A pixel's question, where its surface receives shadows and faces the light.
struct Asked {
    bool asks = false;
    glm::dvec3 from_light{0, 0, 0};
    Lookup lookup;
};

/// Why the pixel of a row differs, where its centre tells.
struct NamedCause {
    int x = 0;
    PixelCause cause;
};

class MapJudge final : public Judge {
public:
    MapJudge(const TracedScene& traced, const Frame& frame)
        : claim_{traced, frame}, receives_(receiving_triangles(traced.scene())),
          view_(light_view(traced.scene(), *frame.mapped, frame.depth_model.subpixel_bits,
                           traced.tracer().threads())),
          light_(*view_), asked_(light_.model()) {
        const Camera& camera = traced.scene().camera;
        for (int x = 0; x < camera.width; ++x) columns_.push_back(ray_column(camera, x + 0.5));
        for (int y = 0; y < camera.height; ++y) rows_.push_back(ray_row(camera, y + 0.5));
        trace_texels();
        name_wrong_answers();
    }

    std::string_view evidence() const override { return "map"; }

    bool settles(PixelPlace p, std::optional<PixelCause>& cause) const override {
        if (!claim_.surface_as_true(p)) return false;
        if (claim_.differs(p)) {
            cause = cause_named(p);
            return cause.has_value();
        }
        const Asked asked = asked_at(p);
        return !asked.asks || answers_so(p, asked);
    }

    std::vector<BandRadius> radii(std::span<const PixelPlace> places) const override {
        std::vector<BandRadius> radii;
        for (const PixelPlace& p : places) {
            const double error = lateral(direction_at(p), depth_at(p));
            radii.push_back({error, error});
        }
        return radii;
    }

    void look_around(const Region& region, const std::vector<Neighbourhood>& around,
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
        const bool is_edge = std::any_of(truth.begin(), truth.end(),
                                         [&](const RayTruth& t) { return t.visibility == claim; });
        if (is_edge)
            finding.cause = {Cause::edge, {}};
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
        const Scene& scene = claim_.traced.scene();
        return {
            scene, claim_.traced.silhouette(), nullptr,
            drawing_of(scene, claim_.frame.depth_model, std::numeric_limits<double>::infinity())};
    }

    EvidenceSummary summary(const EvidenceCheck& check,
                            const Image<std::uint8_t>& /*cause*/) const override {
        const MapFigures figures{
            .straddling = check.in_band, .asked = texels_.size(), .unexplained = not_shown_};
        return summary_of_map(*claim_.frame.mapped, figures, claim_.traced.scene().unit);
    }

    std::shared_ptr<const EvidenceReport> report(const Image<std::uint8_t>& cause,
                                                 const MemoryBudget& /*left*/) const override {
        std::vector<std::optional<PixelLookup>> at(cause.pixels.size());
        parallel_for(cause.height, claim_.traced.tracer().threads(), [&](int y, int) {
            for (int x = 0; x < cause.width; ++x) at[cause.index(x, y)] = lookup_at({x, y});
        });
        return report_map(*claim_.frame.mapped, std::move(at), cause, claim_.traced.scene().unit);
    }

    Account account(const PixelRecord& record, double unit) const override {
        return account_of_lookup(lookup_at({record.x, record.y}), light_.model(), unit);
    }

private:
    JudgedClaim claim_;
    std::vector<std::uint8_t> receives_;
    std::unique_ptr<LightView> view_;
    const LightView& light_;
    std::vector<glm::dvec3> columns_; ///< directions of pixels' centres: the sum of a column's
    std::vector<glm::dvec3> rows_;    ///< and a row's
    TexelSet asked_;                  ///< by pixels' centres
    std::vector<Texel> texels_;       ///< its list
    std::vector<std::optional<std::uint32_t>> shown_; ///< LightView::shown, by each
    std::atomic<std::size_t> not_shown_{0};           ///< how many no rasterizer would store
    std::vector<std::vector<NamedCause>> named_;      ///< by row, in ascending order

    glm::dvec3 direction_at(PixelPlace p) const {
        return columns_[static_cast<std::size_t>(p.x)] + rows_[static_cast<std::size_t>(p.y)];
    }
    double depth_at(PixelPlace p) const {
        return std::min(claim_.traced.truth().depth.at(p.x, p.y), claim_.traced.far());
    }
    double lateral(const glm::dvec3& direction, double depth) const {
        const Scene& scene = claim_.traced.scene();
        return lateral_error(scene, claim_.frame.depth_model, scene.camera.eye + depth * direction);
    }

    bool asks(std::uint32_t triangle) const {
        return receives_[triangle] != 0 && sides_of(claim_.traced.tracer(), triangle).faces_light();
    }

    Asked asked_at(PixelPlace p) const {
        const GroundTruth& truth = claim_.traced.truth();
        const std::uint32_t triangle = truth.triangle.at(p.x, p.y);
        if (triangle == no_triangle || !asks(triangle)) return {};
        if (!truth.in_cone.pixels.empty() && truth.in_cone.at(p.x, p.y) == 0) return {};
        const Scene& scene = claim_.traced.scene();
        Asked asked;
        asked.asks = true;
        asked.from_light =
            scene.camera.eye - light_.origin() + truth.depth.at(p.x, p.y) * direction_at(p);
        asked.lookup = lookup(light_, asked.from_light);
        return asked;
    }

    /// Whether the claim follows from what the pixel's centre asks, and that is as predicted.
    bool answers_so(PixelPlace p, const Asked& asked) const {
        return (!asked.lookup.in_map || are_shown(asked.lookup)) &&
               answer(asked) == claimed_lit(claim_, p);
    }

    /// How many comparisons find light at the pixel's centre, by the map as it was read back.
    int answer(const Asked& asked) const {
        return asked.lookup.in_map ? lit_comparisons(light_, light_.model(), asked.lookup)
                                   : light_.model().asked();
    }

    std::optional<PixelLookup> lookup_at(PixelPlace p) const {
        const Asked asked = asked_at(p);
        if (!asked.asks || !asked.lookup.in_map) return std::nullopt;
        const Texel& texel = asked.lookup.texel;
        return PixelLookup{.lookup = asked.lookup,
                           .stored = value_of_stored(light_.model(), light_.stored(texel)),
                           .shown = shown_by(texel).value_or(no_triangle),
                           .lit = std::max(claimed_lit(claim_, p), 0),
                           .width = width_at(light_, texel, asked.lookup.depth),
                           .footprint = footprint(light_, claim_.traced.scene(), texel,
                                                  claim_.traced.truth().triangle.at(p.x, p.y))};
    }

    void trace_texels() {
        const Image<Visibility>& claim = claim_.frame.claim;
        parallel_for(claim.height, claim_.traced.tracer().threads(), [&](int y, int) {
            for (int x = 0; x < claim.width; ++x)
                if (const Asked asked = asked_at({x, y}); asked.asks && asked.lookup.in_map)
                    add_asked(asked.lookup);
        });
        texels_ = asked_.list(claim_.traced.tracer().threads());
        shown_.resize(texels_.size());
        light_.trace(texels_, [&](std::size_t i, std::uint32_t at_centre) {
            shown_[i] = light_.shown(texels_[i], at_centre);
            if (!shown_[i]) ++not_shown_;
        });
    }

    /// Of a pixel's centre: where its claim is wrong, and follows from what is asked there.
    std::optional<WrongAnswer> wrong_answer(PixelPlace p) const {
        if (!claim_.differs(p) || !claim_.surface_as_true(p)) return std::nullopt;
        const Asked asked = asked_at(p);
        if (!asked.asks || !answers_so(p, asked)) return std::nullopt;
        return WrongAnswer{claim_.traced.truth().triangle.at(p.x, p.y), asked.from_light,
                           asked.lookup, held_by(asked.lookup.texel), claims_light(claim_, p)};
    }

    // Some rows at a time, so that few answers are held at once.
    void name_wrong_answers() {
        const Image<Visibility>& claim = claim_.frame.claim;
        named_.resize(static_cast<std::size_t>(claim.height));
        const int together = std::max(1, (1 << 17) / claim.width);
        for (int first = 0; first < claim.height; first += together)
            name_wrong_answers(first, std::min(together, claim.height - first));
    }

    void name_wrong_answers(int first, int rows) {
        std::vector<std::vector<WrongAnswer>> of_row(static_cast<std::size_t>(rows));
        parallel_for(rows, claim_.traced.tracer().threads(), [&](int row, int) {
            for (int x = 0; x < claim_.frame.claim.width; ++x) {
                const std::optional<WrongAnswer> wrong = wrong_answer({x, first + row});
                if (!wrong) continue;
                of_row[static_cast<std::size_t>(row)].push_back(*wrong);
                named_[static_cast<std::size_t>(first + row)].push_back({x, {}});
            }
        });
        std::vector<WrongAnswer> all;
        for (const std::vector<WrongAnswer>& row : of_row)
            all.insert(all.end(), row.begin(), row.end());
        const std::vector<PixelCause> causes = causes_of(light_, claim_.traced.scene(), all);
        std::size_t next = 0;
        for (int row = 0; row < rows; ++row)
            for (NamedCause& named : named_[static_cast<std::size_t>(first + row)])
                named.cause = causes[next++];
    }

    std::optional<PixelCause> cause_named(PixelPlace p) const {
        const std::vector<NamedCause>& row = named_[static_cast<std::size_t>(p.y)];
        const auto found = std::ranges::lower_bound(row, p.x, {}, &NamedCause::x);
        if (found == row.end() || found->x != p.x) return std::nullopt;
        return found->cause;
    }

    void add_asked(const Lookup& lookup) {
        const int filter = light_.model().filter;
        if (filter == 0 || !lies_within(light_.model(), lookup))
            return visit_asked(light_.model(), lookup,
                               [&](const Texel& texel) { asked_.add(texel); });
        for (int y = 0; y < filter; ++y)
            asked_.add_row({lookup.texel.face, lookup.first.x, lookup.first.y + y},
                           lookup.first.x + filter - 1);
    }

    /// Whether what all texels hold that a pixel's centre asks is as predicted.
    bool are_shown(const Lookup& lookup) const {
        if (not_shown_ == 0) return true;
        bool all = true;
        visit_asked(light_.model(), lookup,
                    [&](const Texel& texel) { all = all && shown_by(texel); });
        return all;
    }

    std::optional<std::uint32_t> shown_by(const Texel& texel) const {
        if (const std::optional<std::size_t> place = asked_.place(texel)) return shown_[*place];
        std::optional<std::uint32_t> shown;
        light_.trace(std::span(&texel, 1), [&](std::size_t, std::uint32_t at_centre) {
            shown = light_.shown(texel, at_centre);
        });
        return shown;
    }

    LightView::Shown held_by(const Texel& texel) const {
        return light_.showing(texel, shown_by(texel).value_or(no_triangle));
    }

    /// The point of a triangle's plane at the pixel as the light pass has it: interpolated over the
    /// triangle, which may be drawn aside.
    UncertainPoint drawn_point(PixelPlace p, std::uint32_t triangle) const {
        const Scene& scene = claim_.traced.scene();
        const Camera& camera = scene.camera;
        const glm::dvec3 to_eye = camera.eye - light_.origin();
        const auto at = [&](double x, double y) {
            const glm::dvec3 direction = ray_direction(camera, x, y);
            const double depth = depth_on_triangle(scene, triangle, direction);
            return to_eye + (depth > 0 ? depth : claim_.traced.far()) * direction;
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
        point.from_light = centre + (depth - on_plane) * direction_at(p);
        const double reach = lateral(direction_at(p), depth);
        for (const double x : {-reach, reach})
            for (const double y : {-reach, reach})
                point.error = glm::max(
                    point.error, glm::abs(at(p.x + 0.5 + x, p.y + 0.5 + y) - point.from_light));
        const Drawing drawing =
            drawing_of(scene, claim_.frame.depth_model, std::numeric_limits<double>::infinity());
        point.error += interpolated_place_error(scene, triangle, {direction_at(p), reach, drawing},
                                                light_.origin());
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
            (!seen(drawn) && !may_cover(scene, drawn, around.rays.front(), spread(around))))
            return false;
        if (!sides_of(claim_.traced.tracer(), drawn).faces_light())
            return claim == Visibility::shadowed;
        const ConeSides cone = cone_sides_around(drawn, truth);
        if (cone.outside && claim == Visibility::shadowed) return true;
        if (!cone.inside) return false;
        if (receives_[drawn] == 0) return claim == Visibility::lit;
        return map_may_answer(p, drawn, claim, cause);
    }

    /// Whether the clipper's errors may displace all that the pixel's surroundings see.
    bool are_displaced(PixelPlace p, const Neighbourhood& around,
                       std::span<const RayTruth> truth) const {
        const Scene& scene = claim_.traced.scene();
        const CoveredPixel pixel{
            direction_at(p), around.reach,
            drawing_of(scene, claim_.frame.depth_model, std::numeric_limits<double>::infinity())};
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
                        [&](const Texel& texel) { shown = shown && shown_by(texel); });
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
        const WrongAnswer wrong{drawn, point.from_light, asked, held_by(asked.texel), falsely_lit};
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
