#include "compare/color_check.h"

#include "compare/freedom.h"
#include "reference/parallel.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace shadowproof {

namespace {

/// What one pixel's claim is held against.
struct Limits {
    Intervals bound;
    Intervals foreseen;
};

bool contains(const Intervals& limits, const glm::dvec3& color) {
    return limits[0].contains(color.x) && limits[1].contains(color.y) &&
           limits[2].contains(color.z);
}

/// By how much an interval's ends lie elsewhere than another's, at most.
double distance(const Interval& a, const Interval& b) {
    return std::max(std::abs(a.low - b.low), std::abs(a.high - b.high));
}

/// Largest distances of limits found elsewhere in a pixel's freedom from those in its middle.
struct Freedom {
    std::array<double, 3> bound{};
    std::array<double, 3> foreseen{};

    void take(const Limits& middle, const Limits& moved) {
        for (std::size_t k = 0; k < 3; ++k) {
            bound[k] = std::max(bound[k], distance(middle.bound[k], moved.bound[k]));
            foreseen[k] = std::max(foreseen[k], distance(middle.foreseen[k], moved.foreseen[k]));
        }
    }
};

constexpr Interval any_number{-std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::infinity()};
constexpr Intervals anything{any_number, any_number, any_number};

class ColorJudge {
public:
    ColorJudge(const Tracer& tracer, const GroundTruth& truth, const Frame& frame)
        : tracer_(tracer), scene_(tracer.scene()), truth_(truth), frame_(frame),
          tables_(make_lighting_tables(scene_, frame.color_model)) {}

    const LightingTables& tables() const { return tables_; }

    bool judges(int x, int y) const {
        const std::uint32_t triangle = truth_.triangle.at(x, y);
        return triangle != no_triangle && frame_.triangle.at(x, y) == triangle &&
               frame_.claim.at(x, y) == truth_.visibility.at(x, y);
    }

    glm::dvec3 claim(int x, int y) const { return frame_.color.at(x, y); }
    SeenPoint point(int x, int y, double dx = 0, double dy = 0) const {
        return {ray_direction(scene_.camera, x + 0.5 + dx, y + 0.5 + dy), truth_.triangle.at(x, y),
                truth_.visibility.at(x, y) == Visibility::lit};
    }

    /// Of the inputs' roundings at the pixel, as a share: see attribute_freedom.
    double share(int x, int y) const {
        const SeenPoint seen = point(x, y);
        return attribute_freedom(
            scene_, seen.triangle,
            {seen.direction, lateral(x, y), drawing_of(scene_, frame_, scene_.camera.far)});
    }

    /// Where a triangle is seen edge-on, all that is interpolated over it may come out as anything.
    Limits limits(const InputPoint& at, double share) const {
        if (!std::isfinite(share)) return {anything, anything};
        const LightingInputs truth = true_inputs(tables_, at);
        const LightingInputs claimed = claimed_inputs(tables_, at, share);
        return {color_bound(frame_.color_model, truth, claimed),
                foreseen_color(frame_.color_model, claimed)};
    }

    /// `middle` with all that the rasterizer's freedom lets it become: corners are snapped, so what
    /// is drawn at a pixel may be of anywhere in a small square around its centre; and texture
    /// coordinates are rounded. Colours are next to linear over so little, but textures have kinks
    /// at their texels: what the square's corners show counts twice.
    Limits freed(const Limits& middle, int x, int y, double share, RayShader& shader) const {
        const std::uint32_t triangle = truth_.triangle.at(x, y);
        const double aside = lateral(x, y);
        const CoordinateFreedom off = coordinate_freedom(scene_, triangle, share);
        std::array<SeenPoint, 5> points{point(x, y)};
        constexpr std::array<glm::dvec2, 4> corners{{{-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};
        for (std::size_t i = 0; i < 4; ++i)
            points[i + 1] = point(x, y, aside * corners[i].x, aside * corners[i].y);
        std::array<Shading, 5> shadings;
        shader.shade(points, shadings);
        Freedom aside_of;
        Freedom off_of;
        for (std::size_t i = 0; i < 4; ++i) {
            aside_of.take(middle, limits({shadings[i + 1], triangle}, share));
            off_of.take(middle, limits({shadings[0], triangle, corners[i] * off.bump,
                                        corners[i] * off.decal},
                                       share));
        }
        Limits freed = middle;
        for (std::size_t k = 0; k < 3; ++k) {
            freed.bound[k] = widened(freed.bound[k], 2 * (aside_of.bound[k] + off_of.bound[k]));
            freed.foreseen[k] =
                widened(freed.foreseen[k], 2 * (aside_of.foreseen[k] + off_of.foreseen[k]));
        }
        return freed;
    }

private:
    const Tracer& tracer_;
    const Scene& scene_;
    const GroundTruth& truth_;
    const Frame& frame_;
    LightingTables tables_;

    double lateral(int x, int y) const {
        const SeenPoint seen = point(x, y);
        return lateral_freedom(scene_, frame_.depth_model,
                               scene_.camera.eye + truth_.depth.at(x, y) * seen.direction);
    }
};

ColorVerdict verdict_of(const Limits& limits, const glm::dvec3& claim) {
    const bool foreseen = contains(limits.foreseen, claim);
    if (contains(limits.bound, claim))
        return foreseen ? ColorVerdict::within : ColorVerdict::unforeseen;
    return foreseen ? ColorVerdict::beyond : ColorVerdict::unexplained;
}

/// Sums over a row, so that they come out the same for any number of threads.
struct RowSums {
    double squares = 0;
    std::uint64_t moved = 0;
    std::uint64_t unforeseen = 0;
};

/// How closely pixels are looked at.
enum class Scrutiny : std::uint8_t { band, centre };

/// Rows that are looked at together. Once so many pixels of those above are beyond explanation, the
/// verdict is beyond doubt: the others are looked at in their centres only.
constexpr int rows_at_once = 16;
constexpr std::uint64_t hopeless = 2048;

bool is_unforeseen(ColorVerdict verdict) {
    return verdict == ColorVerdict::unforeseen || verdict == ColorVerdict::unexplained;
}

RowSums check_row(const ColorJudge& judge, int y, Scrutiny scrutiny, RayShader& shader,
                  ColorCheck& check) {
    std::vector<int> columns;
    std::vector<SeenPoint> points;
    for (int x = 0; x < check.error.width; ++x)
        if (judge.judges(x, y)) {
            columns.push_back(x);
            points.push_back(judge.point(x, y));
        }
    std::vector<Shading> shadings(points.size());
    shader.shade(points, shadings);
    RowSums sums;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const int x = columns[i];
        const glm::dvec3 claim = judge.claim(x, y);
        const glm::dvec3 truth = showable(check.model, shadings[i].color());
        const glm::dvec3 off = 255.0 * glm::abs(claim - truth);
        check.error.at(x, y) = static_cast<float>(std::max({off.x, off.y, off.z}));
        sums.squares += glm::dot(off, off);
        // What holds without the roundings of what is interpolated holds with them, too.
        const InputPoint at{shadings[i], points[i].triangle};
        ColorVerdict verdict = verdict_of(judge.limits(at, 0), claim);
        if (verdict != ColorVerdict::within) {
            const double share = judge.share(x, y);
            const Limits limits = judge.limits(at, share);
            verdict = verdict_of(limits, claim);
            if (verdict != ColorVerdict::within && scrutiny == Scrutiny::band) {
                verdict = verdict_of(judge.freed(limits, x, y, share, shader), claim);
                if (verdict == ColorVerdict::within) ++sums.moved;
            }
        }
        sums.unforeseen += is_unforeseen(verdict) ? 1 : 0;
        check.verdict.at(x, y) = verdict;
    }
    return sums;
}

/// Figures from the pictures, in rows from the top.
void count(ColorCheck& check) {
    std::vector<float> errors;
    for (int y = 0; y < check.error.height; ++y)
        for (int x = 0; x < check.error.width; ++x) {
            const ColorVerdict verdict = check.verdict.at(x, y);
            if (verdict == ColorVerdict::not_judged) continue;
            const float error = check.error.at(x, y);
            errors.push_back(error);
            if (errors.size() == 1 || double{error} > check.largest) {
                check.largest = error;
                check.largest_x = x;
                check.largest_y = y;
            }
            if (verdict == ColorVerdict::beyond) ++check.beyond;
            if (!is_unforeseen(verdict)) continue;
            if (check.unforeseen++ > 0) continue;
            check.first_unforeseen_x = x;
            check.first_unforeseen_y = y;
        }
    check.judged = errors.size();
    if (errors.empty()) return;
    // The smallest error that at least 99.9 % of the pixels do not pass.
    const std::size_t rank = (errors.size() * 999 + 999) / 1000 - 1;
    std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(rank),
                     errors.end());
    check.percentile999 = errors[rank];
}

} // namespace

ColorCheck check_colors(const Tracer& tracer, const GroundTruth& truth, const Frame& frame) {
    assert(!frame.color.pixels.empty() && is_bump_lit(tracer.scene()));
    const int width = frame.color.width;
    const int height = frame.color.height;
    const ColorJudge judge(tracer, truth, frame);
    ColorCheck check;
    check.model = frame.color_model;
    check.error = Image<float>(width, height);
    check.verdict = Image<ColorVerdict>(width, height, ColorVerdict::not_judged);
    std::vector<std::unique_ptr<RayShader>> shaders(static_cast<std::size_t>(tracer.threads()));
    std::vector<RowSums> rows(static_cast<std::size_t>(height));
    std::uint64_t unforeseen = 0;
    for (int first = 0; first < height; first += rows_at_once) {
        const int count = std::min(rows_at_once, height - first);
        const Scrutiny scrutiny = unforeseen < hopeless ? Scrutiny::band : Scrutiny::centre;
        parallel_for(count, tracer.threads(), [&](int i, int thread) {
            std::unique_ptr<RayShader>& shader = shaders[static_cast<std::size_t>(thread)];
            if (!shader) shader = std::make_unique<RayShader>(tracer);
            const int y = first + i;
            rows[static_cast<std::size_t>(y)] = check_row(judge, y, scrutiny, *shader, check);
        });
        for (int i = 0; i < count; ++i)
            unforeseen += rows[static_cast<std::size_t>(first + i)].unforeseen;
    }
    count(check);
    double squares = 0;
    for (const RowSums& row : rows) {
        squares += row.squares;
        check.moved += row.moved;
    }
    if (check.judged > 0) check.rmse = std::sqrt(squares / (3 * static_cast<double>(check.judged)));
    return check;
}

ColorAccount account_for_color(const Tracer& tracer, const GroundTruth& truth, const Frame& frame,
                               int x, int y) {
    const ColorJudge judge(tracer, truth, frame);
    const ColorModel& model = frame.color_model;
    ColorAccount account;
    account.claim = judge.claim(x, y);
    if (truth.triangle.at(x, y) == no_triangle) return account;
    RayShader shader(tracer);
    const SeenPoint point = judge.point(x, y);
    shader.shade({&point, 1}, {&account.truth, 1});
    account.showable = showable(model, account.truth.color());
    const double share = judge.share(x, y);
    const InputPoint at{account.truth, point.triangle};
    Limits limits = judge.limits(at, share);
    if (!contains(limits.bound, account.claim) || !contains(limits.foreseen, account.claim))
        limits = judge.freed(limits, x, y, share, shader);
    account.bound = limits.bound;
    account.foreseen = limits.foreseen;
    if (judge.judges(x, y)) account.verdict = verdict_of(limits, account.claim);
    const LightingInputs true_in = true_inputs(judge.tables(), at);
    const LightingInputs claimed_in = claimed_inputs(judge.tables(), at, share);
    for (const ColorTerm term : all_color_terms)
        account.weights[static_cast<std::size_t>(term)] =
            255 * weight_of(term, model, true_in, claimed_in);
    return account;
}

} // namespace shadowproof
