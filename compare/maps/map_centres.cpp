#include "compare/maps/map_centres.h"

#include "compare/maps/footprint.h"
#include "compare/maps/map_cause.h"
#include "compare/maps/map_claim.h"
#include "reference/parallel.h"
#include "reference/trace/faces.h"

#include <algorithm>

namespace shadowproof {

MapCentres::MapCentres(const JudgedClaim& claim, const LightView& light)
    : claim_(claim), light_(light), receives_(receiving_triangles(claim.traced.scene())),
      asked_(light.model()) {
    const Camera& camera = claim.traced.scene().camera;
    for (int x = 0; x < camera.width; ++x) columns_.push_back(sight_column(camera, x + 0.5));
    for (int y = 0; y < camera.height; ++y) rows_.push_back(sight_row(camera, y + 0.5));
    for (std::uint32_t triangle = 0; triangle < receives_.size(); ++triangle)
        asks_.push_back(receives(triangle) &&
                        sides_of(claim.traced.tracer(), triangle).faces_light());
    trace_texels();
    name_wrong_answers();
}

bool MapCentres::settles(PixelPlace p, std::optional<PixelCause>& cause) const {
    if (!claim_.surface_as_true(p)) return false;
    if (claim_.differs(p)) {
        cause = cause_named(p);
        return cause.has_value();
    }
    const Asked asked = asked_at(p);
    return !asked.asks || answers_so(p, asked);
}

MapCentres::Asked MapCentres::asked_at(PixelPlace p) const {
    const GroundTruth& truth = claim_.traced.truth();
    const std::uint32_t triangle = truth.triangle.at(p.x, p.y);
    if (triangle == no_triangle || asks_[triangle] == 0) return {};
    if (!truth.in_cone.pixels.empty() && truth.in_cone.at(p.x, p.y) == 0) return {};
    const Scene& scene = claim_.traced.scene();
    Asked asked;
    asked.asks = true;
    const glm::dvec3 line = line_at(p);
    asked.from_light = start_of(scene.camera, line) - light_.origin() +
                       truth.depth.at(p.x, p.y) * direction_of(scene.camera, line);
    asked.lookup = lookup(light_, asked.from_light);
    return asked;
}

bool MapCentres::answers_so(PixelPlace p, const Asked& asked) const {
    return (!asked.lookup.in_map || are_shown(asked.lookup)) &&
           answer(asked) == claimed_lit(claim_, p);
}

int MapCentres::answer(const Asked& asked) const {
    return asked.lookup.in_map ? lit_comparisons(light_, light_.model(), asked.lookup)
                               : light_.model().asked();
}

std::optional<PixelLookup> MapCentres::lookup_at(PixelPlace p) const {
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

void MapCentres::trace_texels() {
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

std::optional<WrongAnswer> MapCentres::wrong_answer(PixelPlace p) const {
    if (!claim_.differs(p) || !claim_.surface_as_true(p)) return std::nullopt;
    const Asked asked = asked_at(p);
    if (!asked.asks || !answers_so(p, asked)) return std::nullopt;
    return WrongAnswer{claim_.traced.truth().triangle.at(p.x, p.y), asked.from_light, asked.lookup,
                       held_by(asked.lookup.texel), claims_light(claim_, p)};
}

// Some rows at a time, so that few answers are held at once.
void MapCentres::name_wrong_answers() {
    const Image<Visibility>& claim = claim_.frame.claim;
    named_.resize(static_cast<std::size_t>(claim.height));
    const int together = std::max(1, (1 << 17) / claim.width);
    for (int first = 0; first < claim.height; first += together)
        name_wrong_answers(first, std::min(together, claim.height - first));
}

void MapCentres::name_wrong_answers(int first, int rows) {
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

std::optional<PixelCause> MapCentres::cause_named(PixelPlace p) const {
    const std::vector<NamedCause>& row = named_[static_cast<std::size_t>(p.y)];
    const auto found = std::ranges::lower_bound(row, p.x, {}, &NamedCause::x);
    if (found == row.end() || found->x != p.x) return std::nullopt;
    return found->cause;
}

void MapCentres::add_asked(const Lookup& lookup) {
    const int filter = light_.model().filter;
    if (filter == 0 || !lies_within(light_.model(), lookup))
        return visit_asked(light_.model(), lookup, [&](const Texel& texel) { asked_.add(texel); });
    for (int y = 0; y < filter; ++y)
        asked_.add_row({lookup.texel.face, lookup.first.x, lookup.first.y + y},
                       lookup.first.x + filter - 1);
}

bool MapCentres::are_shown(const Lookup& lookup) const {
    if (not_shown_ == 0) return true;
    bool all = true;
    visit_asked(light_.model(), lookup, [&](const Texel& texel) { all = all && shown_by(texel); });
    return all;
}

std::optional<std::uint32_t> MapCentres::shown_by(const Texel& texel) const {
    if (const std::optional<std::size_t> place = asked_.place(texel)) return shown_[*place];
    std::optional<std::uint32_t> shown;
    light_.trace(std::span(&texel, 1), [&](std::size_t, std::uint32_t at_centre) {
        shown = light_.shown(texel, at_centre);
    });
    return shown;
}

LightView::Shown MapCentres::held_by(const Texel& texel) const {
    return light_.showing(texel, shown_by(texel).value_or(no_triangle));
}

} // namespace shadowproof
