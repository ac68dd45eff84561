#include "compare/color/color_check.h"

#include "compare/color/color_judge.h"
#include "compare/driver/lighting/lighting_arithmetic.h"
#include "reference/parallel.h"
#include "reference/shade/added_shader.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace shadowproof {

namespace {

/// In the widest channel, in steps of 1/255. NaN counts as the widest.
double width_of(const Intervals& bound) {
    constexpr double most = std::numeric_limits<float>::max();
    double widest = 0;
    for (const Interval& channel : bound) {
        const double wide = 255 * width(channel);
        widest = std::max(widest, std::isfinite(wide) ? std::min(wide, most) : most);
    }
    return widest;
}

ColorTerm heaviest(const ColorTerms& weights) {
    return static_cast<ColorTerm>(std::max_element(weights.begin(), weights.end()) -
                                  weights.begin());
}

/// Sums over a row, so that they come out the same for any number of threads.
struct RowSums {
    double squares = 0;
    double squares_elsewhere = 0; ///< where surface or visibility are not the truth's
    std::uint64_t interpolated = 0;
    std::uint64_t unpredicted = 0;
    std::array<std::uint64_t, all_color_terms.size()> beyond_by{};
};

/// Rows that are judged together: how closely, those above decide.
constexpr int rows_at_once = 16;

bool is_unpredicted(ColorVerdict verdict) {
    return verdict == ColorVerdict::unpredicted || verdict == ColorVerdict::unexplained;
}

/// What is truly seen at each pixel.
struct TruePicture {
    const Camera& camera;
    const GroundTruth& truth;
    const TracedLights& before;

    bool is_background(int x, int y) const { return truth.triangle.at(x, y) == no_triangle; }
    /// One per light, the chosen one last.
    std::vector<SeenPoint> seen(int x, int y) const {
        std::vector<SeenPoint> points;
        const auto add = [&](const GroundTruth& under) {
            points.push_back({line_of_sight(camera, x + 0.5, y + 0.5), truth.triangle.at(x, y),
                              under.visibility.at(x, y) == Visibility::lit});
        };
        for (const auto& light : before) add(light->truth);
        add(truth);
        return points;
    }
    /// Shaded under the chosen light; background is black.
    Shading shaded(int x, int y, AddedShader& shader) const {
        if (is_background(x, y)) return {};
        const std::vector<SeenPoint> points = seen(x, y);
        std::vector<Shading> shadings(points.size());
        shader.shade(points, shadings);
        return shadings.back();
    }
};

/// Of the pixels of a row whose colour is only held against what they show, the squared differences
/// from the true colours.
double squares_elsewhere(const ColorJudge& judge, const TruePicture& picture, int y,
                         AddedShader& shader, const ColorCheck& check) {
    double squares = 0;
    for (int x = 0; x < check.verdict.width; ++x) {
        if (check.verdict.at(x, y) != ColorVerdict::as_shown) continue;
        const glm::dvec3 right = judge.right_color(x, y, picture.shaded(x, y, shader).color());
        const glm::dvec3 off = 255.0 * (judge.claim(x, y) - right);
        squares += glm::dot(off, off);
    }
    return squares;
}

RowSums check_row(const ColorJudge& judge, const TruePicture& picture, int y, Scrutiny scrutiny,
                  AddedShader& shader, ColorCheck& check, Image<float>& widths) {
    std::vector<int> columns;
    std::vector<SeenPoint> points;
    RowSums sums;
    const auto add_error = [&](int x, const glm::dvec3& right) {
        const glm::dvec3 off = 255.0 * glm::abs(judge.claim(x, y) - right);
        check.error.at(x, y) = static_cast<float>(std::max({off.x, off.y, off.z}));
        sums.squares += glm::dot(off, off);
    };
    for (int x = 0; x < check.error.width; ++x) {
        if (!judge.shows_background(x, y)) {
            columns.push_back(x);
            judge.append_points(x, y, points);
            continue;
        }
        check.verdict.at(x, y) = judge.judged_background(x, y);
        if (check.verdict.at(x, y) == ColorVerdict::as_shown) continue;
        add_error(x, glm::dvec3(0));
        ++sums.unpredicted;
    }
    std::vector<Shading> shadings(points.size());
    shader.shade(points, shadings);
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const int x = columns[i];
        const std::size_t lights = shader.lights();
        const auto at_pixel = std::span<const Shading>(shadings).subspan(i * lights, lights);
        const ColorJudgement found = judge.judged(x, y, at_pixel, scrutiny);
        check.verdict.at(x, y) = found.verdict;
        if (found.verdict == ColorVerdict::as_shown) continue;
        add_error(x, judge.right_color(x, y, at_pixel.back().color()));
        widths.at(x, y) = static_cast<float>(width_of(found.bound));
        if (is_unpredicted(found.verdict)) ++sums.unpredicted;
        if (found.verdict == ColorVerdict::within && (found.spread.aside || found.spread.share > 0))
            ++sums.interpolated;
        if (found.verdict == ColorVerdict::beyond) {
            const ColorTerm term =
                heaviest(judge.weights(x, y, at_pixel, points[i * lights].triangle, found.spread));
            ++sums.beyond_by[static_cast<std::size_t>(term)];
        }
    }
    sums.squares_elsewhere = squares_elsewhere(judge, picture, y, shader, check);
    return sums;
}

/// The smallest of the numbers that at least `per_mille` of them do not exceed.
double percentile(std::vector<float>& numbers, std::size_t per_mille) {
    const std::size_t rank = (numbers.size() * per_mille + 999) / 1000 - 1;
    std::nth_element(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(rank),
                     numbers.end());
    return numbers[rank];
}

/// Figures from the pictures, in rows from the top.
void count(ColorCheck& check, const Image<float>& bound_widths) {
    std::vector<float> errors;
    std::vector<float> widths;
    for (int y = 0; y < check.error.height; ++y)
        for (int x = 0; x < check.error.width; ++x) {
            const ColorVerdict verdict = check.verdict.at(x, y);
            if (verdict == ColorVerdict::as_shown) continue;
            const float error = check.error.at(x, y);
            errors.push_back(error);
            widths.push_back(bound_widths.at(x, y));
            if (errors.size() == 1 || double{error} > check.largest) {
                check.largest = error;
                check.largest_x = x;
                check.largest_y = y;
            }
            if (verdict == ColorVerdict::beyond) ++check.beyond;
            if (verdict == ColorVerdict::moved) ++check.moved;
            if (!is_unpredicted(verdict)) continue;
            if (check.unpredicted++ > 0) continue;
            check.first_unpredicted_x = x;
            check.first_unpredicted_y = y;
        }
    check.judged = errors.size();
    if (errors.empty()) return;
    check.percentile999 = percentile(errors, 999);
    check.bound_width = {.median = percentile(widths, 500),
                         .percentile999 = percentile(widths, 999),
                         .widest = percentile(widths, 1000)};
}

LightAdded added(const TracedLight& light, const Image<Visibility>& claim) {
    LightAdded added{.name = chosen_light(light.scene).choice};
    for (std::size_t i = 0; i < claim.pixels.size(); ++i)
        added.differing += claim.pixels[i] != light.truth.visibility.pixels[i] ? 1 : 0;
    return added;
}

} // namespace

ColorCheck check_colors(const Tracer& tracer, const GroundTruth& truth, const Frame& frame,
                        const TracedLights& before, const PixelMeans* means) {
    assert(!frame.color.pixels.empty() && is_bump_lit(tracer.scene()));
    const int width = frame.color.width;
    const int height = frame.color.height;
    const ColorJudge judge(tracer, truth, before, frame, means);
    const TruePicture picture{tracer.scene().camera, truth, before};
    ColorCheck check;
    check.model = frame.color_model;
    for (std::size_t i = 0; i < before.size(); ++i)
        check.lights_before.push_back(added(*before[i], frame.claims_before[i]));
    check.error = Image<float>(width, height);
    check.verdict = Image<ColorVerdict>(width, height, ColorVerdict::as_shown);
    Image<float> widths(width, height);
    const AddedShader first_shader(tracer, before);
    std::vector<std::unique_ptr<AddedShader>> shaders(static_cast<std::size_t>(tracer.threads()));
    std::vector<RowSums> rows(static_cast<std::size_t>(height));
    std::uint64_t unpredicted = 0;
    for (int first = 0; first < height; first += rows_at_once) {
        const int count = std::min(rows_at_once, height - first);
        const Scrutiny scrutiny = scrutiny_after(unpredicted);
        parallel_for(count, tracer.threads(), [&](int i, int thread) {
            std::unique_ptr<AddedShader>& shader = shaders[static_cast<std::size_t>(thread)];
            if (!shader) shader = std::make_unique<AddedShader>(first_shader);
            const int y = first + i;
            rows[static_cast<std::size_t>(y)] =
                check_row(judge, picture, y, scrutiny, *shader, check, widths);
        });
        for (int i = 0; i < count; ++i)
            unpredicted += rows[static_cast<std::size_t>(first + i)].unpredicted;
    }
    count(check, widths);
    double squares = 0;
    double all_squares = 0;
    for (const RowSums& row : rows) {
        squares += row.squares;
        all_squares += row.squares + row.squares_elsewhere;
        check.interpolated += row.interpolated;
        for (std::size_t i = 0; i < row.beyond_by.size(); ++i)
            check.beyond_by[i] += row.beyond_by[i];
    }
    if (check.judged > 0) check.rmse = std::sqrt(squares / (3 * static_cast<double>(check.judged)));
    check.picture_rmse = std::sqrt(all_squares / (3.0 * width * height));
    if (means != nullptr) check.means = check_means(*means, frame, check.verdict);
    return check;
}

ColorAccount account_for_color(const Tracer& tracer, const GroundTruth& truth, const Frame& frame,
                               int x, int y, const TracedLights& before) {
    PixelMeans means;
    if (filters(frame.color_model)) means = shade_pixel(tracer, truth, x, y, before);
    const ColorJudge judge(tracer, truth, before, frame, &means);
    const ColorModel& model = frame.color_model;
    ColorAccount account;
    account.claim = judge.claim(x, y);
    for (std::size_t i = 0; i < before.size(); ++i)
        account.lights_before.push_back({chosen_light(before[i]->scene).choice,
                                         before[i]->truth.visibility.at(x, y),
                                         frame.claims_before[i].at(x, y)});
    AddedShader shader(tracer, before);
    account.truth = TruePicture{tracer.scene().camera, truth, before}.shaded(x, y, shader);
    account.showable = judge.right_color(x, y, account.truth.color());
    if (filters(model)) account.rays = means.rays.at(x, y);
    if (judge.shows_background(x, y)) {
        account.verdict = judge.judged_background(x, y);
        return account;
    }
    std::vector<SeenPoint> points;
    judge.append_points(x, y, points);
    std::vector<Shading> shown(points.size());
    shader.shade(points, shown);
    const ColorJudgement found = judge.judged(x, y, shown, Scrutiny::band);
    account.verdict = found.verdict;
    account.bound = found.bound;
    account.predicted = found.predicted;
    account.weights = judge.weights(x, y, shown, points.front().triangle, found.spread);
    for (double& weight : account.weights) weight *= 255;
    return account;
}

} // namespace shadowproof
