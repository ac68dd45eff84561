// Where else the light would have to be for the picture's shadows.
#include "compare/picture/hypotheses.h"
#include "scenes/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

namespace shadowproof {

namespace {

Predict with_light_moved(const Trial& trial, const glm::dvec3& by) {
    return truth_of(
        [&scene = trial.scene(), by] {
            Scene moved = scene;
            Light& light = moved.lights[moved.light];
            if (light.kind == Light::Kind::directional)
                light.direction = glm::normalize(light.direction + by);
            else
                light.position += by;
            return moved;
        },
        trial.traced().tracer().threads());
}

struct LightMove {
    glm::dvec3 by{0, 0, 0};
    std::int64_t score = 0;
};

/// The trial, and how many more predictions it may take: each builds the scene's tree anew.
struct Search {
    Trial& trial;
    int left = 0;

    /// Less than any score once there are none left.
    std::int64_t score_of(const glm::dvec3& by) {
        if (left-- <= 0) return std::numeric_limits<std::int64_t>::min();
        return trial.fit(with_light_moved(trial, by)).score();
    }
};

/// Of each search: so many that it takes a second or two, but no less than two rounds of six steps
/// at each of eight sizes need.
int affordable_predictions(const Scene& scene) {
    constexpr std::size_t triangles_in_all = 5'000'000;
    constexpr std::size_t fewest = 96;
    constexpr std::size_t most = 300;
    return static_cast<int>(std::clamp(
        triangles_in_all / std::max<std::size_t>(scene.triangles.size(), 1), fewest, most));
}

/// The unit vectors between two or three axes.
std::vector<glm::dvec3> diagonals(const std::array<glm::dvec3, 3>& axes) {
    std::vector<glm::dvec3> ways;
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z)
                if (std::abs(x) + std::abs(y) + std::abs(z) >= 2)
                    ways.push_back(glm::normalize(double(x) * axes[0] + double(y) * axes[1] +
                                                  double(z) * axes[2]));
    return ways;
}

/// Steps along one axis after the other, again and again, and as far again in the direction in
/// which they led (Hooke and Jeeves, "Direct search solution of numerical and statistical
/// problems", 1961); where none is better, between the axes; where none is better still, steps
/// halve.
LightMove climbed(Search& search, const std::array<glm::dvec3, 3>& axes, double step,
                  double least) {
    constexpr int rounds = 20; // of seven predictions, and of twenty more before steps halve
    LightMove best;
    const auto look = [&](const glm::dvec3& by) {
        const std::int64_t score = search.score_of(by);
        if (score > best.score) best = {by, score};
    };
    for (int round = 0; round < rounds && step >= least; ++round) {
        const LightMove from = best;
        for (const glm::dvec3& axis : axes) {
            const glm::dvec3 here = best.by;
            for (const double sign : {-1.0, 1.0}) look(here + sign * step * axis);
        }
        if (best.score == from.score)
            for (const glm::dvec3& way : diagonals(axes)) look(from.by + step * way);
        if (best.score == from.score)
            step /= 2;
        else
            look(best.by + (best.by - from.by));
    }
    return best;
}

/// The smallest move that fits no worse, by steps that halve where none leads to a smaller one.
LightMove contracted(Search& search, const std::array<glm::dvec3, 3>& axes, LightMove best,
                     double least) {
    constexpr int rounds = 20; // of six predictions
    double step = glm::length(best.by) / 2;
    for (int round = 0; round < rounds && step >= least; ++round) {
        const LightMove from = best;
        for (const glm::dvec3& axis : axes)
            for (const double sign : {-1.0, 1.0}) {
                const glm::dvec3 by = from.by + sign * step * axis;
                if (glm::length(by) >= glm::length(best.by)) continue;
                const std::int64_t score = search.score_of(by);
                if (score >= best.score) best = {by, score};
            }
        if (best.by == from.by) step /= 2;
    }
    return best;
}

/// The middle, along its way, of a smallest move and of a larger one up to which all fit as well:
/// up to 64 times as large, and to within a hundredth of it.
LightMove centred(Search& search, const LightMove& smallest) {
    constexpr int bisections = 8;
    double fits = 1;
    double fails = 2;
    while (fails < 64 && search.score_of(fails * smallest.by) >= smallest.score) {
        fits = fails;
        fails *= 2;
    }
    for (int i = 0; i < bisections; ++i) {
        const double middle = (fits + fails) / 2;
        (search.score_of(middle * smallest.by) >= smallest.score ? fits : fails) = middle;
    }
    const glm::dvec3 by = (1 + fits) / 2 * smallest.by;
    const std::int64_t score = search.score_of(by);
    return score >= smallest.score ? LightMove{by, score} : smallest;
}

} // namespace

/// Steps across the way to what is seen, and along it: across, shadows move; towards it they only
/// grow. The first are a tenth of the light's distance, or of its direction where it is
/// directional; and a hundredth, from where a small move is not taken for a larger one along the
/// way.
void try_moved_light(Trial& trial) {
    const Scene& scene = trial.scene();
    const Light& light = chosen_light(scene);
    const Image<double>& depths = trial.truth().depth;
    const double depth =
        std::min(depths.at(depths.width / 2, depths.height / 2), trial.traced().far());
    const glm::dvec3 point = point_on(scene.camera, eye_line(scene.camera), depth);
    const bool directional = light.kind == Light::Kind::directional;
    const glm::dvec3 way = directional ? light.direction : point - light.position;
    if (!(glm::length(way) > 0)) return;
    const glm::dvec3 towards = glm::normalize(way);
    const glm::dvec3 hint = std::abs(towards.y) < 0.5 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 across = glm::normalize(glm::cross(towards, hint));
    const std::array<glm::dvec3, 3> axes{across, glm::cross(towards, across), towards};
    constexpr double finest = 2e-4; // moves shadows by less than most pixels
    const int predictions = affordable_predictions(scene);
    LightMove best;
    for (const double share : {0.1, 0.01}) {
        Search search{trial, predictions};
        const LightMove found =
            climbed(search, axes, share * glm::length(way), finest * glm::length(way));
        if (found.score > best.score) best = found;
    }
    if (best.score <= 0) return;
    // Shadows that move within an edge's band are not wrong: many moves fit as well as the best.
    Search search{trial, predictions};
    best = centred(search, contracted(search, axes, best, finest * glm::length(way)));
    const glm::dvec3& by = best.by;
    trial.consider("light_moved", {{"x", by.x}, {"y", by.y}, {"z", by.z}},
                   fmt::format("the light is moved by ({:.3g}, {:.3g}, {:.3g})", by.x, by.y, by.z),
                   with_light_moved(trial, by));
}

} // namespace shadowproof
