#include "compare/driver/sufficient_depths.h"

#include "compare/driver/error_bounds.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace shadowproof {

namespace {

/// Beyond all numbers that a scene's admission lets floats have.
constexpr double greatest_depth = 0x1p60;

/// The place in [from, to] where `holds` changes: it is true at one end, and changes once.
template <class Predicate>
double change_between(double from, double to, const Predicate& holds) {
    const bool at_start = holds(from);
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (from + to);
        (holds(middle) == at_start ? from : to) = middle;
    }
    return at_start ? from : to;
}

} // namespace

// The error is a square of the depth, or proportional to it, plus the float transform's terms, each
// the size of a linear function: a convex function of the depth t. A pixel's width is w t. So
// error(t) / t - w decreases to its lowest place and increases from there, or only decreases: the
// depths that suffice are one interval. The place is found by thirds. Parallel lines of sight have
// pixels of one width w, and error(t) - w does the same; their depths may begin at 0.
SufficientDepths sufficient_depths(const Scene& scene, const DepthModel& depth_model) {
    const Camera& camera = scene.camera;
    const bool is_parallel = camera.is_orthographic();
    const double width_of_pixel = 2 * camera.half_height / camera.height;
    const auto error_in_pixels = [&](double t) {
        return depth_error(scene, depth_model, camera.eye + t * camera.forward) /
               (is_parallel ? 1 : t);
    };
    const auto suffices = [&](double t) { return error_in_pixels(t) <= width_of_pixel; };
    double low = camera.near;
    double high = greatest_depth;
    for (int i = 0; i < (is_parallel ? 300 : 100); ++i) {
        // In perspective by the depth's logarithm: depths differ by many orders.
        const double ratio = std::cbrt(high / low);
        const double third = (high - low) / 3;
        const double nearer = is_parallel ? low + third : low * ratio;
        const double further = is_parallel ? high - third : high / ratio;
        if (error_in_pixels(nearer) <= error_in_pixels(further))
            high = further;
        else
            low = nearer;
    }
    const double best = suffices(camera.near) ? camera.near : low;
    if (!suffices(best))
        return {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    SufficientDepths depths{camera.near, std::numeric_limits<double>::infinity()};
    if (!suffices(camera.near)) depths.nearest = change_between(camera.near, best, suffices);
    if (!suffices(greatest_depth)) depths.furthest = change_between(best, greatest_depth, suffices);
    return depths;
}

std::string words_of(const SufficientDepths& depths, double near, double unit) {
    if (depths.nearest > depths.furthest) return "at no depth";
    const bool ends = std::isfinite(depths.furthest);
    std::string words;
    if (depths.nearest > near)
        words = fmt::format("from {:.4g}{}", depths.nearest * unit, ends ? " " : "");
    if (ends) words += fmt::format("to {:.4g}", depths.furthest * unit);
    return words.empty() ? "at any depth" : words;
}

} // namespace shadowproof
