#include "compare/color/color_judge.h"

#include "compare/driver/cone_side.h"
#include "compare/driver/error_bounds.h"
#include "compare/driver/lighting/error_budget.h"
#include "compare/driver/setup_error.h"
#include "reference/trace/faces.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

namespace shadowproof {

namespace {

bool contains(const Intervals& limits, const glm::dvec3& color) {
    return limits[0].contains(color.x) && limits[1].contains(color.y) &&
           limits[2].contains(color.z);
}

bool contains(const std::vector<Intervals>& limits, const glm::dvec3& color) {
    return std::ranges::any_of(limits,
                               [&](const Intervals& limit) { return contains(limit, color); });
}

/// To be shown: the one that holds the colour, or all of them.
Intervals shown_of(const std::vector<Intervals>& limits, const glm::dvec3& color) {
    Intervals all = limits.front();
    for (const Intervals& limit : limits) {
        if (contains(limit, color)) return limit;
        all = hull(all, limit);
    }
    return all;
}

constexpr Intervals anything{any_number, any_number, any_number};

constexpr std::array<glm::dvec2, 4> corners_of_square{{{-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};

/// Anywhere on a triangle.
constexpr PixelSpread all_of_it{.middle = glm::dvec3(1.0 / 3),
                                .corners = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 1}}},
                                .aside = true};

/// How often the region that the rasterizer may draw is halved. Each part's interval holds all
/// colours of the part. Its excess, from treating dependent values as independent, halves with the
/// part. More halvings give narrower intervals and take longer; no interval is too narrow.
constexpr int halvings_of_square = 3;

/// A technique that uses floats alone is never right beyond a step of the truth.
constexpr double one_step = 1 / 255.0;

bool within_a_step(const glm::dvec3& claim, const glm::dvec3& truth) {
    const glm::dvec3 off = glm::abs(claim - truth);
    return std::max({off.x, off.y, off.z}) <= one_step;
}

Intervals cut_to_a_step(Intervals bound, const glm::dvec3& truth) {
    for (std::size_t k = 0; k < 3; ++k) {
        const Interval step = around(truth[static_cast<int>(k)], one_step);
        bound[k] = {std::max(bound[k].low, step.low), std::min(bound[k].high, step.high)};
    }
    return bound;
}

} // namespace

ColorJudge::ColorJudge(const Tracer& tracer, const GroundTruth& truth, const TracedLights& before,
                       const Frame& frame, const PixelMeans* means)
    : tracer_(tracer), scene_(tracer.scene()), truth_(truth), frame_(frame),
      means_(filters(frame.color_model) ? means : nullptr),
      tables_(make_lighting_tables(scene_, frame.color_model)) {
    assert(before.size() == frame.claims_before.size());
    assert(means != nullptr || !filters(frame.color_model));
    for (std::size_t i = 0; i < before.size(); ++i)
        lights_.push_back(
            {before[i]->tracer, before[i]->scene, before[i]->truth, frame.claims_before[i]});
    lights_.push_back({tracer, scene_, truth, frame.claim});
}

bool ColorJudge::is_as_true(int x, int y) const {
    return !shows_background(x, y) && shown(x, y) == truth_.triangle.at(x, y) &&
           std::ranges::all_of(lights_, [&](const AddedLight& light) {
               return light.claim.at(x, y) == light.truth.visibility.at(x, y);
           });
}

glm::dvec3 ColorJudge::line(int x, int y, const glm::dvec2& beside) const {
    return line_of_sight(scene_.camera, x + 0.5 + beside.x, y + 0.5 + beside.y);
}

void ColorJudge::append_points(int x, int y, std::vector<SeenPoint>& points) const {
    for (const AddedLight& light : lights_)
        points.push_back({line(x, y), shown(x, y), light.claim.at(x, y) == Visibility::lit});
}

template <class Of>
auto ColorJudge::of_lights(std::span<const Shading> shadings, std::uint32_t triangle,
                           const PixelSpread& spread, const Of& of) const {
    std::vector<decltype(of(std::declval<const InputPoint&>()))> each;
    each.reserve(lights_.size());
    for (std::size_t i = 0; i < lights_.size(); ++i)
        each.push_back(of(input_point(lights_[i].scene, shadings[i], triangle, spread)));
    return each;
}

glm::dvec3 ColorJudge::right_color(int x, int y, const glm::dvec3& at_centre) const {
    return showable(frame_.color_model, means_ != nullptr ? means_->color.at(x, y) : at_centre);
}

/// A technique that filters is right within a step of the mean, however it normalises.
std::vector<Intervals> ColorJudge::bounds(const PixelPlace& pixel,
                                          const PixelSpread& spread) const {
    if (means_ != nullptr) return {around(means_->color.at(pixel.x, pixel.y), one_step)};
    std::vector<Intervals> colors;
    const auto add = [&](std::span<const Shading> shadings) {
        colors.push_back(
            color_bound(frame_.color_model,
                        of_lights(shadings, pixel.triangle, spread, [&](const InputPoint& point) {
                            return budgeted_inputs(tables_, point);
                        })));
    };
    add(pixel.shadings);
    for (const std::vector<Shading>& lit : pixel.at_cones) add(lit);
    return colors;
}

std::vector<Intervals> ColorJudge::predicted(const PixelPlace& pixel,
                                             const PixelSpread& spread) const {
    const auto choices =
        footprint_choices(tables_, input_point(scene_, pixel.own(), pixel.triangle, spread));
    std::vector<Intervals> colors;
    const auto add = [&](std::span<const Shading> shadings, const FootprintChoice& choice) {
        const auto claimed = [&](const InputPoint& point) {
            return claimed_inputs(tables_, point, choice);
        };
        colors.push_back(predicted_color(frame_.color_model,
                                         of_lights(shadings, pixel.triangle, spread, claimed)));
    };
    for (const FootprintChoice& choice : choices) {
        add(pixel.shadings, choice);
        for (const std::vector<Shading>& lit : pixel.at_cones) add(lit, choice);
    }
    return colors;
}

/// With each choice of those lights lit. Whatever else is known to keep a light out keeps it out
/// wherever the cone's edge is found: the triangle's side, and a counter that is not 0.
std::vector<std::vector<Shading>> ColorJudge::shadings_at_cones(const PixelPlace& pixel) const {
    std::vector<std::size_t> in_doubt;
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        const AddedLight& light = lights_[i];
        if (chosen_light(light.scene).kind != Light::Kind::spot || pixel.shadings[i].lit) continue;
        if (!sides_of(light.tracer, pixel.triangle).faces_light()) continue;
        const bool receives = light.scene.meshes[mesh_of(light.scene, pixel.triangle)].receives;
        const bool counted = receives && frame_.counted && i + 1 == lights_.size();
        if (counted && frame_.counted->counter.at(pixel.x, pixel.y) != 0) continue;
        const ConeSides sides = cone_sides(light.scene, frame_.depth_model, scene_.camera.far,
                                           pixel.triangle, pixel.x, pixel.y);
        if (sides.inside && sides.outside) in_doubt.push_back(i);
    }
    constexpr std::size_t most_in_doubt = 8; // cones whose edges meet in a pixel
    in_doubt.resize(std::min(in_doubt.size(), most_in_doubt));
    std::vector<std::vector<Shading>> choices;
    for (std::size_t lit = 1; lit < std::size_t{1} << in_doubt.size(); ++lit) {
        choices.emplace_back(pixel.shadings.begin(), pixel.shadings.end());
        for (std::size_t k = 0; k < in_doubt.size(); ++k)
            if ((lit >> k & 1U) != 0) choices.back()[in_doubt[k]].lit = true;
    }
    return choices;
}

/// View depth of the surface shown; where the truth is another, of its plane.
double ColorJudge::depth(int x, int y) const {
    if (shown(x, y) == truth_.triangle.at(x, y)) return truth_.depth.at(x, y);
    return depth_on_triangle(scene_, shown(x, y), line(x, y));
}

double ColorJudge::lateral(int x, int y) const {
    return lateral_error(scene_, frame_.depth_model,
                         point_on(scene_.camera, line(x, y), depth(x, y)));
}

/// Of all lights, to which other vectors are interpolated each: at a place beside the pixel's
/// centre, of the triangle that is shown at the centre.
DrawnAttribute ColorJudge::drawn(int x, int y, const glm::dvec2& beside) const {
    const Drawing drawing = drawing_of(scene_, frame_.depth_model, scene_.camera.far);
    const double aside = lateral(x, y);
    DrawnAttribute largest;
    for (const AddedLight& light : lights_) {
        const DrawnAttribute drawn =
            drawn_attribute(light.scene, shown(x, y), {line(x, y, beside), aside, drawing});
        largest.share = std::max(largest.share, drawn.share);
        largest.aside = std::max(largest.aside, drawn.aside);
    }
    return largest;
}

/// What a pixel that filters may read of its neighbours. Where the spread is the pixel's centre
/// alone, that is what exact numbers have there.
void ColorJudge::add_quad(const PixelPlace& pixel, const Square& square,
                          PixelSpread& spread) const {
    if (means_ == nullptr) return;
    const auto [column, row] = quad_neighbours(pixel.x, pixel.y, frame_.color.height);
    const auto way = [&](double columns, double rows) {
        return line(pixel.x, pixel.y, {columns, rows}) - line(pixel.x, pixel.y);
    };
    QuadRays quad{.to_column = way(column, 0), .to_row = way(0, row)};
    for (std::size_t i = 0; i < corners_of_square.size(); ++i)
        quad.rays[i] = line(pixel.x, pixel.y, square.middle + square.half * corners_of_square[i]);
    if (spread.share > 0) quad.share = pixel.quad_share;
    if (spread.aside) quad.stretch = pixel.quad_stretch;
    spread.quad = quad;
}

void ColorJudge::find_quad_errors(PixelPlace& pixel, double own_share) const {
    if (means_ == nullptr) return;
    const auto [x, y] = std::pair(pixel.x, pixel.y);
    const auto [column, row] = quad_neighbours(x, y, frame_.color.height);
    pixel.quad_share =
        std::max({own_share, drawn(x, y, {column, 0}).share, drawn(x, y, {0, row}).share});
    const Drawing drawing = drawing_of(scene_, frame_.depth_model, scene_.camera.far);
    pixel.quad_stretch =
        drawn_stretch(scene_, pixel.triangle, {line(x, y), lateral(x, y), drawing});
}

double ColorJudge::facing(std::uint32_t triangle, const glm::dvec3& line) const {
    const glm::dvec3 a = corner(scene_, triangle, 0);
    return glm::dot(direction_of(scene_.camera, line),
                    glm::cross(corner(scene_, triangle, 1) - a, corner(scene_, triangle, 2) - a));
}

/// Nothing of the triangle lies past the horizon of its plane.
PixelSpread ColorJudge::over(const PixelPlace& pixel, const Square& square, double share) const {
    const double towards = facing(pixel.triangle, line(pixel.x, pixel.y));
    PixelSpread spread{.aside = true, .share = share};
    spread.middle = weights_along(scene_, pixel.triangle, line(pixel.x, pixel.y, square.middle));
    for (std::size_t i = 0; i < corners_of_square.size(); ++i) {
        const glm::dvec3 ray =
            line(pixel.x, pixel.y, square.middle + square.half * corners_of_square[i]);
        if (!(towards * facing(pixel.triangle, ray) > 0)) {
            spread = all_of_it;
            spread.share = share;
            return spread;
        }
        spread.corners[i] = weights_along(scene_, pixel.triangle, ray);
    }
    add_quad(pixel, square, spread);
    return spread;
}

/// Whether the claim is within the limit somewhere in the square, as far as halving it tells.
template <class Limit>
bool ColorJudge::somewhere(const PixelPlace& pixel, const Square& square, double share,
                           int halvings, const Limit& limit) const {
    if (!contains(limit(over(pixel, square, share)), claim(pixel.x, pixel.y))) return false;
    if (halvings == 0) return true;
    return std::ranges::any_of(corners_of_square, [&](const glm::dvec2& corner) {
        const double half = square.half / 2;
        return somewhere(pixel, {square.middle + half * corner, half}, share, halvings - 1, limit);
    });
}

/// Because corners are snapped, a technique may draw at a pixel any place in a small square around
/// its centre. `right`, `is_predicted`: what is settled without the square.
ColorJudgement ColorJudge::judged_aside(const PixelPlace& pixel, const DrawnAttribute& drawn,
                                        bool right, bool is_predicted) const {
    ColorJudgement found;
    const double share = drawn.share;
    // If a triangle is seen edge-on, interpolated values may come out as anything. The right
    // colours are still those of the triangle.
    const bool edge_on = !std::isfinite(share) || !std::isfinite(drawn.aside);
    const Square square{{0, 0}, lateral(pixel.x, pixel.y) + drawn.aside};
    found.spread = edge_on ? all_of_it : over(pixel, square, share);
    const auto bounds_of = [&](const PixelSpread& spread) { return bounds(pixel, spread); };
    const auto predicted_of = [&](const PixelSpread& spread) { return predicted(pixel, spread); };
    const glm::dvec3 claimed = claim(pixel.x, pixel.y);
    const std::vector<Intervals> anywhere = bounds_of(found.spread);
    found.bound = shown_of(anywhere, claimed);
    found.predicted = edge_on ? anything : shown_of(predicted_of(found.spread), claimed);
    if (edge_on) {
        right = right || contains(anywhere, claimed);
        is_predicted = true;
    } else {
        right = right || somewhere(pixel, square, share, halvings_of_square, bounds_of);
        is_predicted =
            is_predicted || somewhere(pixel, square, share, halvings_of_square, predicted_of);
    }
    const glm::dvec3 truth = pixel.own().color();
    const bool exact = is_exact(frame_.color_model, scene_);
    if (exact) found.bound = cut_to_a_step(found.bound, truth);
    if (!right) {
        found.verdict = is_predicted ? ColorVerdict::beyond : ColorVerdict::unexplained;
    } else if (exact && !within_a_step(claimed, truth)) {
        found.verdict = is_predicted ? ColorVerdict::moved : ColorVerdict::unexplained;
    } else {
        found.verdict = is_predicted ? ColorVerdict::within : ColorVerdict::unpredicted;
    }
    return found;
}

/// A wrong surface or visibility has no right colour, but one that the arithmetic predicts.
ColorJudgement ColorJudge::judged(int x, int y, std::span<const Shading> shadings,
                                  Scrutiny scrutiny) const {
    const PixelPlace pixel{x, y, shadings, shown(x, y)};
    ColorJudgement found = judged_as_shown(pixel, scrutiny);
    if (is_as_true(x, y)) return found;
    const bool is_predicted = found.verdict == ColorVerdict::within ||
                              found.verdict == ColorVerdict::beyond ||
                              found.verdict == ColorVerdict::moved;
    found.verdict = is_predicted ? ColorVerdict::as_shown : ColorVerdict::unexplained;
    return found;
}

ColorVerdict ColorJudge::judged_background(int x, int y) const {
    return claim(x, y) == glm::dvec3(0) ? ColorVerdict::as_shown : ColorVerdict::unexplained;
}

/// As if what is shown were the truth. What holds at the centre, without rounding of interpolated
/// values, also holds for the whole square with it.
ColorJudgement ColorJudge::judged_as_shown(PixelPlace pixel, Scrutiny scrutiny) const {
    const Shading& shading = pixel.own();
    const glm::dvec3 claimed = claim(pixel.x, pixel.y);
    const auto look = [&](const PixelSpread& spread) {
        const std::vector<Intervals> possible = predicted(pixel, spread);
        std::vector<Intervals> right = bounds(pixel, spread);
        if (is_exact(frame_.color_model, scene_))
            for (Intervals& bound : right) bound = cut_to_a_step(bound, shading.color());
        ColorJudgement found{.bound = shown_of(right, claimed),
                             .predicted = shown_of(possible, claimed),
                             .spread = spread};
        const bool is_predicted = contains(possible, claimed);
        if (contains(right, claimed))
            found.verdict = is_predicted ? ColorVerdict::within : ColorVerdict::unpredicted;
        else
            found.verdict = is_predicted ? ColorVerdict::beyond : ColorVerdict::unexplained;
        return found;
    };
    PixelSpread spread{.middle = shading.weights};
    add_quad(pixel, {}, spread);
    // A bound about a mean is the same wherever the rasterizer drew.
    const auto is_settled = [&](ColorVerdict verdict) {
        return verdict == ColorVerdict::within ||
               (means_ != nullptr && verdict == ColorVerdict::beyond);
    };
    const ColorJudgement exactly = look(spread);
    if (is_settled(exactly.verdict)) return exactly;
    const std::vector<std::vector<Shading>> at_cones = shadings_at_cones(pixel);
    pixel.at_cones = at_cones;
    const DrawnAttribute drawn = this->drawn(pixel.x, pixel.y);
    spread.share = drawn.share;
    const bool finite = std::isfinite(spread.share);
    find_quad_errors(pixel, spread.share);
    add_quad(pixel, {}, spread);
    ColorJudgement rounded = exactly;
    if (finite) rounded = look(spread);
    if (is_settled(rounded.verdict) || scrutiny == Scrutiny::centre) return rounded;
    const bool right = rounded.verdict == ColorVerdict::unpredicted;
    const bool is_predicted = rounded.verdict == ColorVerdict::beyond;
    return judged_aside(pixel, drawn, right, is_predicted);
}

ColorTerms ColorJudge::weights(int x, int y, std::span<const Shading> shadings,
                               std::uint32_t triangle, const PixelSpread& spread) const {
    const PixelPlace pixel{x, y, shadings, triangle};
    PixelSpread centre{.middle = shadings.back().weights};
    add_quad(pixel, {}, centre);
    const auto each = [&](const PixelSpread& where, const auto& of) {
        return of_lights(shadings, triangle, where, of);
    };
    const auto claimed = [&](const InputPoint& point) { return claimed_inputs(tables_, point); };
    const auto truth = each(centre, [&](const InputPoint& at) { return true_inputs(tables_, at); });
    const auto single =
        each(centre, [&](const InputPoint& at) { return single_step_inputs(tables_, at); });
    const auto at_centre = each(centre, claimed);
    const auto freed = each(spread, claimed);
    const ColorSteps steps{truth, single, at_centre, freed};
    if (means_ == nullptr) return weights_of(frame_.color_model, steps);
    return weights_of(frame_.color_model, steps,
                      PixelColors{means_->color.at(x, y), means_->alike.at(x, y)});
}

} // namespace shadowproof
