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
// depths that suffice are one interval. The place is found by thirds.
SufficientDepths sufficient_depths(const Scene& scene, const DepthModel& depth_model) {
    const Camera& camera = scene.camera;
    const double width_of_pixel = 2 * camera.half_height / camera.height;
    const auto relative_error = [&](double t) {
        return depth_error(scene, depth_model, camera.eye + t * camera.forward) / t;
    };
    const auto suffices = [&](double t) { return relative_error(t) <= width_of_pixel; };
    double low = camera.near;
    double high = greatest_depth;
    for (int i = 0; i < 100; ++i) { // by the depth's logarithm: depths differ by many orders
        const double ratio = std::cbrt(high / low);
        if (relative_error(low * ratio) <= relative_error(high / ratio))
            high /= ratio;
        else
            low *= ratio;
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
