#include "compare/maps/slope_offset.h"

#include "scenes/roundoff.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

namespace shadowproof {

namespace {

constexpr double v = float_roundoff;

/// The size of a product of differences less another, and by how much it may be off.
struct Determinant {
    double size = 0;
    double error = 0;

    double least() const { return std::max(size - error, 0.0); }
    double most() const { return size + error; }
};

/// a d - b c, each of whose factors is off by an error of its own. Differences, products and their
/// difference round by v of their sizes, and what is divided and multiplied after it once more
/// each: 6 v of both terms.
Determinant determinant(double a, double b, double c, double d, double error_of_ab,
                        double error_of_cd) {
    const double terms = std::abs(a * d) + std::abs(b * c);
    return {std::abs(a * d - b * c), error_of_ab * (std::abs(c) + std::abs(d)) +
                                         error_of_cd * (std::abs(a) + std::abs(b)) +
                                         2 * error_of_ab * error_of_cd + 6 * v * terms};
}

} // namespace

// OpenGL 4.5, section 14.6.5: the slope is the length of the gradient, or the larger of its
// components instead. Of a polygon that is drawn as several triangles, each may have its own.
SlopeOffset slope_offset(const std::vector<PicturePoint>& polygon, double factor, double scale,
                         double reach) {
    SlopeOffset offset{0, std::numeric_limits<double>::infinity(), 0};
    if (factor == 0 || polygon.size() < 3) return {};
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        const PicturePoint& a = polygon[0];
        const PicturePoint& b = polygon[i - 1];
        const PicturePoint& c = polygon[i];
        const double moved = 2 * (reach + std::max({a.place_error, b.place_error, c.place_error}));
        const double deeper = 2 * std::max({a.depth_error, b.depth_error, c.depth_error});
        const glm::dvec2 d01 = a.place - b.place;
        const glm::dvec2 d20 = c.place - a.place;
        const double z01 = a.inverse_depth - b.inverse_depth;
        const double z20 = c.inverse_depth - a.inverse_depth;
        const Determinant area = determinant(d01.x, d01.y, d20.x, d20.y, moved, moved);
        const Determinant x = determinant(z01, d01.y, z20, d20.y, 0, 0);
        const Determinant y = determinant(z01, d01.x, z20, d20.x, 0, 0);
        const auto off = [&](double one, double other) {
            return deeper * (std::abs(one) + std::abs(other) + 2 * moved) +
                   moved * (std::abs(z01) + std::abs(z20));
        };
        const Determinant along_x{x.size, x.error + off(d01.y, d20.y)};
        const Determinant along_y{y.size, y.error + off(d01.x, d20.x)};
        const double times = factor * scale;
        const double least = std::max(along_x.least(), along_y.least()) / area.most();
        const double most = area.least() > 0
                                ? std::hypot(along_x.most(), along_y.most()) / area.least()
                                : std::numeric_limits<double>::infinity();
        offset.own = std::max(offset.own, times * std::max(x.size, y.size) / area.size);
        offset.least = std::min(offset.least, times * least * (1 - 4 * v));
        offset.most = std::max(offset.most, times * most * (1 + 4 * v));
    }
    return offset;
}

} // namespace shadowproof
