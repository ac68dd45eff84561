#include "compare/driver/quad_steps.h"

#include "scenes/driver.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace shadowproof {

namespace {

/// A number that is linear in a line of sight: in its direction D or, of parallel ones, in its
/// start S.
struct LinearForm {
    glm::dvec3 slope{0, 0, 0};
    double constant = 0;

    double at(const glm::dvec3& line) const { return glm::dot(line, slope) + constant; }
    double change(const glm::dvec3& step) const { return glm::dot(step, slope); }
};

/// A value of the triangle where a line meets its plane is the quotient of these.
struct LinearForms {
    LinearForm value;
    LinearForm all;
};

/// With the weights of the corners as in shading.h, step 1: what D is multiplied with there is
/// linear in a - S.
LinearForms forms_of(const Scene& scene, std::uint32_t triangle, const glm::dvec3& values) {
    const Camera& camera = scene.camera;
    const glm::dvec3 first = corner(scene, triangle, 0);
    const glm::dvec3 e = corner(scene, triangle, 1) - first;
    const glm::dvec3 f = corner(scene, triangle, 2) - first;
    const glm::dvec3 normal = glm::cross(e, f);
    const glm::dvec3 along = (values.y - values.x) * f - (values.z - values.x) * e;
    if (!camera.is_orthographic())
        return {{values.x * normal + glm::cross(along, first - camera.eye), 0}, {normal, 0}};
    const double all = glm::dot(camera.forward, normal);
    const glm::dvec3 slope = -glm::cross(camera.forward, along);
    return {{slope, values.x * all - glm::dot(slope, first)}, {glm::dvec3(0), all}};
}

/// A difference, and the size of the values that it is of: the neighbour's, which may lie beside
/// the triangle.
struct Step {
    Interval range = any_number;
    double size = 0;
};

/// With u = U / W, both linear, the step from D by d is (u(d) W(D) - U(D) w(d)) / (W(D) W(D + d)),
/// u and w being what they change by. The numerator is linear in D and in d, and so extreme at
/// corners of both.
Step step_of(const LinearForms& forms, const QuadRays& quad, const glm::dvec3& step) {
    const std::array<glm::dvec3, 4> steps{step + quad.stretch * (quad.to_column + quad.to_row),
                                          step + quad.stretch * (quad.to_column - quad.to_row),
                                          step - quad.stretch * (quad.to_column - quad.to_row),
                                          step - quad.stretch * (quad.to_column + quad.to_row)};
    Interval own;  // W(D)
    Interval next; // W(D + S)
    Interval numerator;
    double most = 0; // of U(D + S)
    for (std::size_t i = 0; i < quad.rays.size(); ++i)
        for (std::size_t k = 0; k < steps.size(); ++k) {
            const double all = forms.all.at(quad.rays[i]);
            const double all_step = forms.all.change(steps[k]);
            const double value = forms.value.at(quad.rays[i]);
            const double value_step = forms.value.change(steps[k]);
            const Interval product = around(value_step * all - value * all_step);
            const bool first = i == 0 && k == 0;
            own = first ? around(all) : hull(own, around(all));
            next = first ? around(all + all_step) : hull(next, around(all + all_step));
            numerator = first ? product : hull(numerator, product);
            most = std::max(most, std::abs(value + value_step));
        }
    const Interval denominator = own * next;
    if (!(denominator.low > 0)) return {}; // of a pixel and its neighbour W has one sign
    return {numerator * Interval{1 / denominator.high, 1 / denominator.low},
            most / std::min(std::abs(next.low), std::abs(next.high))};
}

} // namespace

// What is linear over a triangle is drawn as it is at other places of it, T(x) = x + d(x): T takes
// the drawn corners to the true ones, and so does any place by the same weights, which makes d
// linear. At corners, and so all over the triangle, |d| is at most `aside` along each axis. Nowhere
// is the triangle narrower than its least height; over that d changes by 2 `aside` at most.
double drawn_stretch(const Scene& scene, std::uint32_t triangle, const CoveredPixel& pixel) {
    const auto at = [&](int k) { return glm::dvec4(corner(scene, triangle, k), 1); };
    const auto fan = set_up(scene.camera, {at(0), at(1), at(2)}, pixel.drawing);
    const glm::dvec2 place = place_of(scene.camera, pixel.line);
    double covering = 0;
    double any = 0;
    for (const std::array<PicturePoint, 3>& drawn : fan) {
        double aside = 0;
        double longest = 0;
        for (std::size_t k = 0; k < drawn.size(); ++k) {
            aside = std::max(aside, pixel.reach + drawn[k].place_error);
            longest = std::max(longest, glm::distance(drawn[k].place, drawn[(k + 1) % 3].place));
        }
        const glm::dvec2 b = drawn[1].place - drawn[0].place;
        const glm::dvec2 c = drawn[2].place - drawn[0].place;
        // Of the drawn triangle, whose corners may be closer.
        const double height =
            std::abs(b.x * c.y - b.y * c.x) / longest - 2 * std::numbers::sqrt2 * aside;
        const double stretch =
            height > 0 ? 2 * aside / height : std::numeric_limits<double>::infinity();
        any = std::max(any, stretch);
        if (may_reach(drawn, place, pixel.reach)) covering = std::max(covering, stretch);
    }
    if (fan.empty()) return std::numeric_limits<double>::infinity();
    return covering > 0 ? covering : any;
}

// The pixel's value is off by its share of the largest corner's. That share is of a value no larger
// than those: q = p / r, both off by e, is off by (1 + |q|) e / (r - e), and the neighbour's q may
// be more than 1. Their difference is rounded.
PlaceSteps quad_steps(const Scene& scene, std::uint32_t triangle,
                      const std::array<glm::dvec2, 3>& values, const QuadRays& quad) {
    PlaceSteps steps;
    if (!std::isfinite(quad.stretch) || !std::isfinite(quad.share)) return steps;
    for (int k = 0; k < 2; ++k) {
        const glm::dvec3 at_corners(values[0][k], values[1][k], values[2][k]);
        const LinearForms forms = forms_of(scene, triangle, at_corners);
        const glm::dvec3 sizes = glm::abs(at_corners);
        const double largest = std::max({sizes.x, sizes.y, sizes.z});
        const auto rounded = [&](const Step& step) {
            const double neighbour = std::max(largest, 0.5 * (largest + step.size));
            const double off = quad.share * (largest + neighbour);
            return widened(step.range, off + float_roundoff * size_of(step.range));
        };
        const auto axis = static_cast<std::size_t>(k);
        steps.across[axis] = rounded(step_of(forms, quad, quad.to_column));
        steps.down[axis] = rounded(step_of(forms, quad, quad.to_row));
    }
    return steps;
}

} // namespace shadowproof
