#include "compare/bench/growth.h"

#include "compare/bench/interval.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace shadowproof {

namespace {

struct Line {
    Exponent slope;
    double residual = 0; ///< sum of squares
};

/// 97.5 % quantile of Student's t for 1 to 10 degrees of freedom (Draper and Smith 1998, table A);
/// beyond, that of 10, which is wider than need be.
double student(std::size_t freedom) {
    constexpr std::array quantiles{12.706, 4.303, 3.182, 2.776, 2.571,
                                   2.447,  2.365, 2.306, 2.262, 2.228};
    return quantiles[std::min(freedom, quantiles.size()) - 1];
}

std::optional<Line> fit(std::span<const GrowthPoint> points) {
    if (points.size() < 3) return std::nullopt;
    const auto n = static_cast<double>(points.size());
    std::vector<double> across;
    std::vector<double> up;
    for (const GrowthPoint& point : points) {
        const double median = median_interval(point.samples).median;
        if (!(point.size > 0) || !(median > 0)) return std::nullopt; // no logarithm
        across.push_back(std::log(point.size));
        up.push_back(std::log(median));
    }
    const auto mean = [&](const std::vector<double>& values) {
        double sum = 0;
        for (const double value : values) sum += value;
        return sum / n;
    };
    const double middle = mean(across);
    const double height = mean(up);
    double spread = 0;
    double together = 0;
    for (std::size_t i = 0; i < across.size(); ++i) {
        spread += (across[i] - middle) * (across[i] - middle);
        together += (across[i] - middle) * (up[i] - height);
    }
    if (spread == 0) return std::nullopt; // one size alone
    Line line;
    const double slope = together / spread;
    for (std::size_t i = 0; i < across.size(); ++i) {
        const double off = up[i] - height - slope * (across[i] - middle);
        line.residual += off * off;
    }
    const double half = student(points.size() - 2) * std::sqrt(line.residual / (n - 2) / spread);
    line.slope = {slope, slope - half, slope + half};
    return line;
}

} // namespace

std::optional<Exponent> exponent_of(const std::vector<GrowthPoint>& points) {
    const std::optional<Line> line = fit(points);
    if (!line) return std::nullopt;
    return line->slope;
}

std::optional<GrowthBreak> break_of(const std::vector<GrowthPoint>& points) {
    std::optional<GrowthBreak> best;
    double least = std::numeric_limits<double>::infinity();
    const std::span all(points);
    for (std::size_t at = 2; at + 2 < points.size(); ++at) {
        const std::optional<Line> below = fit(all.first(at + 1));
        const std::optional<Line> above = fit(all.subspan(at));
        if (!below || !above || below->residual + above->residual >= least) continue;
        least = below->residual + above->residual;
        best = GrowthBreak{points[at].size, below->slope, above->slope};
    }
    const bool apart =
        best && (best->below.high < best->above.low || best->above.high < best->below.low);
    return apart ? best : std::nullopt;
}

} // namespace shadowproof
