#include "compare/picture/diagnosis.h"

#include "reference/predict/prediction.h"
#include "scenes/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <optional>

namespace shadowproof {

namespace {

/// How well a predicted picture fits.
struct Fit {
    std::uint64_t explained = 0;
    std::uint64_t contradicted = 0;
    std::int64_t score() const {
        return static_cast<std::int64_t>(explained) - static_cast<std::int64_t>(contradicted);
    }
};

/// A hypothesis at one value of its parameter.
using Predict = std::function<Image<Visibility>(double)>;

class Diagnostician {
public:
    Diagnostician(const TracedScene& traced, const Frame& frame, const Image<std::uint8_t>& cause)
        : traced_(traced), scene_(traced.scene()), truth_(traced.truth()), frame_(frame),
          cause_(cause) {
        for (const std::uint8_t each : cause.pixels)
            wrong_ += each == static_cast<std::uint8_t>(Cause::unexplained) ? 1U : 0U;
    }

    std::vector<Diagnosis> run() {
        if (wrong_ == 0) return {};
        // The cheap ones first; what explains all and contradicts nothing needs no rival.
        for (const auto tried : {&Diagnostician::try_operations, &Diagnostician::try_lights,
                                 &Diagnostician::try_meshes, &Diagnostician::try_one_sided,
                                 &Diagnostician::try_counters, &Diagnostician::try_near_plane,
                                 &Diagnostician::try_far_plane, &Diagnostician::try_length,
                                 &Diagnostician::try_range, &Diagnostician::try_moved_light})
            if (best() < static_cast<std::int64_t>(wrong_)) (this->*tried)();
        std::stable_sort(found_.begin(), found_.end(), [](const Diagnosis& a, const Diagnosis& b) {
            return score_of(a) > score_of(b);
        });
        if (found_.size() > most) found_.resize(most);
        return std::move(found_);
    }

private:
    static constexpr std::size_t most = 5;

    const TracedScene& traced_;
    const Scene& scene_;
    const GroundTruth& truth_;
    const Frame& frame_;
    const Image<std::uint8_t>& cause_;
    std::uint64_t wrong_ = 0;
    std::vector<Diagnosis> found_;

    static std::int64_t score_of(const Diagnosis& diagnosis) {
        return static_cast<std::int64_t>(diagnosis.explained) -
               static_cast<std::int64_t>(diagnosis.contradicted);
    }
    std::int64_t best() const {
        std::int64_t best = 0;
        for (const Diagnosis& each : found_) best = std::max(best, score_of(each));
        return best;
    }

    bool faces_light(std::size_t pixel) const {
        const std::uint32_t triangle = truth_.triangle.pixels[pixel];
        return triangle != no_triangle && sides_of(traced_.tracer(), triangle).faces_light();
    }
    bool in_cone(std::size_t pixel) const {
        return truth_.in_cone.pixels.empty() || truth_.in_cone.pixels[pixel] != 0;
    }

    /// Whether the pixel lies within one class of the predicted picture: next to others, half a
    /// pixel decides.
    static bool is_inside(const Image<Visibility>& predicted, int x, int y) {
        for (int v = std::max(y - 1, 0); v <= std::min(y + 1, predicted.height - 1); ++v)
            for (int u = std::max(x - 1, 0); u <= std::min(x + 1, predicted.width - 1); ++u)
                if (predicted.at(u, v) != predicted.at(x, y)) return false;
        return true;
    }

    Fit fit(const Image<Visibility>& predicted) const {
        Fit fit;
        const Image<std::uint8_t>& decided = frame_.pictured->decided;
        for (int y = 0; y < predicted.height; ++y)
            for (int x = 0; x < predicted.width; ++x) {
                if (decided.at(x, y) == 0) continue;
                const bool as_claimed = predicted.at(x, y) == frame_.claim.at(x, y);
                const std::uint8_t cause = cause_.at(x, y);
                if (cause == static_cast<std::uint8_t>(Cause::unexplained))
                    fit.explained += as_claimed ? 1U : 0U;
                else if (cause == no_difference && !as_claimed && is_inside(predicted, x, y))
                    ++fit.contradicted;
            }
        return fit;
    }

    void consider(std::string hypothesis, std::vector<std::pair<std::string, double>> parameters,
                  const Image<Visibility>& predicted, std::string words) {
        const Fit found = fit(predicted);
        if (found.score() <= 0) return;
        found_.push_back({std::move(hypothesis), std::move(parameters), found.explained,
                          found.contradicted, std::move(words)});
    }

    /// The best value of a parameter between two, which are positive: in equal ratios, then more
    /// finely around the best. Where too much is wrong by one value and nothing by the next, the
    /// right one lies in between, and is found by bisection.
    void search(const std::string& hypothesis, const std::string& parameter, double from, double to,
                const Predict& predict, const std::function<std::string(double)>& words) {
        constexpr int steps = 12;
        constexpr int refinements = 4;
        constexpr int bisections = 14;
        double best_value = from;
        std::int64_t best_score = 0;
        const auto look = [&](double value) {
            const Fit found = fit(predict(value));
            if (found.score() > best_score) {
                best_score = found.score();
                best_value = value;
            }
            return found;
        };
        const auto is_too_much = [](const Fit& fit) { return fit.contradicted > fit.explained; };
        double ratio = std::pow(to / from, 1.0 / steps);
        std::vector<Fit> fits;
        for (int i = 0; i <= steps; ++i) fits.push_back(look(from * std::pow(ratio, i)));
        for (std::size_t i = 0; i < steps; ++i) {
            if (is_too_much(fits[i]) == is_too_much(fits[i + 1])) continue;
            double low = from * std::pow(ratio, i);
            double high = low * ratio;
            for (int k = 0; k < bisections; ++k) {
                const double middle = std::sqrt(low * high);
                (is_too_much(look(middle)) == is_too_much(fits[i]) ? low : high) = middle;
            }
        }
        for (int round = 0; round < refinements && best_score > 0; ++round) {
            ratio = std::pow(ratio, 1.0 / 3);
            const double middle = best_value;
            for (const int step : {-2, -1, 1, 2}) look(middle * std::pow(ratio, step));
        }
        if (best_score > 0)
            consider(hypothesis, {{parameter, best_value}}, predict(best_value), words(best_value));
    }

    Image<Visibility>
    changed(const std::function<Visibility(std::size_t, Visibility)>& change) const {
        Image<Visibility> predicted = truth_.visibility;
        for (std::size_t i = 0; i < predicted.pixels.size(); ++i)
            if (faces_light(i)) predicted.pixels[i] = change(i, predicted.pixels[i]);
        return predicted;
    }

    static Image<Visibility> truth_of(const Scene& scene) {
        const Tracer tracer(scene);
        return trace(tracer).visibility;
    }

    void try_operations() {
        consider("no_shadow", {}, changed([&](std::size_t i, Visibility) {
                     return in_cone(i) ? Visibility::lit : Visibility::shadowed;
                 }),
                 "no shadow is drawn");
        consider("inverted", {}, changed([&](std::size_t, Visibility truth) {
                     return truth == Visibility::lit ? Visibility::shadowed : Visibility::lit;
                 }),
                 "light and shadow are exchanged");
    }

    void try_lights() {
        for (std::size_t light = 0; light < scene_.lights.size(); ++light) {
            if (light == scene_.light) continue;
            Scene other = scene_;
            other.light = light;
            consider("other_light", {{"light", static_cast<double>(light)}}, truth_of(other),
                     fmt::format("the shadows are those of light {} ({})", light,
                                 scene_.lights[light].name));
        }
    }

    /// One mesh after the other, those first that cover most of the picture; each takes a trace.
    void try_meshes() {
        constexpr std::size_t most_meshes = 24;
        for (std::size_t m = 0; m < std::min(scene_.meshes.size(), most_meshes); ++m) {
            const Mesh& mesh = scene_.meshes[m];
            const std::vector<std::pair<std::string, double>> number{
                {"mesh", static_cast<double>(m)}};
            if (mesh.receives)
                consider("receiver_missing", number, changed([&](std::size_t i, Visibility truth) {
                             return mesh_of(scene_, truth_.triangle.pixels[i]) == m && in_cone(i)
                                        ? Visibility::lit
                                        : truth;
                         }),
                         fmt::format("{} shows no shadows", mesh.name));
            if (mesh.casts && scene_.meshes.size() > 1) {
                Scene without = scene_;
                without.meshes[m].casts = false;
                consider("caster_missing", number, truth_of(without),
                         fmt::format("{} throws no shadow", mesh.name));
            }
        }
    }

    /// The scene with only those triangles casting that `casts` names. Triangles are in another
    /// order.
    Scene cast_by(const std::function<bool(std::uint32_t)>& casts) const {
        Scene parted = scene_;
        parted.triangles.clear();
        parted.surfaces.clear();
        parted.meshes.clear();
        for (const Mesh& mesh : scene_.meshes)
            for (const bool casting : {true, false}) {
                Mesh part = mesh;
                part.first_triangle = static_cast<std::uint32_t>(parted.triangles.size());
                part.casts = mesh.casts && casting;
                for (std::uint32_t i = 0; i < mesh.triangle_count; ++i)
                    if (casts(mesh.first_triangle + i) == casting)
                        parted.triangles.push_back(scene_.triangles[mesh.first_triangle + i]);
                part.triangle_count =
                    static_cast<std::uint32_t>(parted.triangles.size()) - part.first_triangle;
                if (part.triangle_count > 0) parted.meshes.push_back(part);
            }
        return parted;
    }

    void try_one_sided() {
        for (const bool fronts : {true, false})
            consider("one_sided_casters", {{"front", fronts ? 1.0 : 0.0}},
                     truth_of(cast_by([&](std::uint32_t triangle) {
                         const TriangleSides sides = sides_of(traced_.tracer(), triangle);
                         return fronts ? sides.front_to_light : sides.back_to_light;
                     })),
                     fmt::format("only triangles whose {} is towards the light throw shadows",
                                 fronts ? "front" : "back"));
    }

    /// Nothing is shadowed further from the light than a shadow map reaches.
    void try_range() {
        const Light& light = chosen_light(scene_);
        if (light.kind == Light::Kind::directional) return;
        Image<double> distance(truth_.depth.width, truth_.depth.height);
        double nearest = std::numeric_limits<double>::infinity();
        double furthest = 0;
        for (int y = 0; y < distance.height; ++y)
            for (int x = 0; x < distance.width; ++x) {
                if (truth_.triangle.at(x, y) == no_triangle) continue;
                const glm::dvec3 point =
                    scene_.camera.eye +
                    truth_.depth.at(x, y) * ray_direction(scene_.camera, x + 0.5, y + 0.5);
                const double d = glm::distance(point, light.position);
                distance.at(x, y) = d;
                nearest = std::min(nearest, d);
                furthest = std::max(furthest, d);
            }
        if (!(nearest > 0) || !(furthest > nearest)) return;
        search(
            "shadow_map", "range", nearest, furthest,
            [&](double range) {
                return changed([&](std::size_t i, Visibility truth) {
                    return distance.pixels[i] > range && in_cone(i) ? Visibility::lit : truth;
                });
            },
            [](double range) {
                return fmt::format("a shadow map that reaches {:.4g} from the light", range);
            });
    }

    /// What is claimed where shadow volumes are counted so.
    static Image<Visibility> counted(const TracedScene& traced, const Counting& counting,
                                     const DepthModel& depth_model) {
        const Prediction prediction(traced.volumes(), counting, depth_model);
        const GroundTruth& truth = traced.truth();
        Image<Visibility> predicted = truth.visibility;
        for (std::size_t i = 0; i < predicted.pixels.size(); ++i) {
            const std::uint32_t triangle = truth.triangle.pixels[i];
            if (triangle == no_triangle || !sides_of(traced.tracer(), triangle).faces_light())
                continue;
            const bool in_cone = truth.in_cone.pixels.empty() || truth.in_cone.pixels[i] != 0;
            const bool unshadowed = stored(prediction.counts().pixels[i], counting) == 0;
            predicted.pixels[i] = unshadowed && in_cone ? Visibility::lit : Visibility::shadowed;
        }
        return predicted;
    }

    void try_counters() {
        using Test = Counting::Test;
        const DepthModel infinite{.projection = DepthModel::Projection::infinite,
                                  .near = scene_.camera.near};
        const auto behind = [](const std::function<void(Counting&)>& change) {
            Counting counting{.test = Test::depth_fail, .flips = {.around_light = true}};
            change(counting);
            return counting;
        };
        consider("missing_cap", {{"light_cap", 0}},
                 counted(traced_, behind([](Counting& c) { c.light_cap = false; }), infinite),
                 "z-fail without light caps");
        consider("missing_cap", {{"dark_cap", 0}},
                 counted(traced_, behind([](Counting& c) { c.dark_cap = false; }), infinite),
                 "z-fail without dark caps");
        for (const int bits : {1, 2, 3, 4})
            consider("stencil_bits", {{"bits", bits}},
                     counted(traced_, behind([&](Counting& c) { c.bits = bits; }), infinite),
                     fmt::format("a counter of {} that wraps",
                                 bits == 1 ? "1 bit" : fmt::format("{} bits", bits)));
    }

    void try_near_plane() {
        const Counting in_front{.test = Counting::Test::depth_pass, .dark_cap = false};
        const double near = scene_.camera.near;
        search(
            "zpass", "near", near / 16, near * 16,
            [&](double value) {
                Scene scene = scene_;
                scene.camera.near = value;
                const Tracer tracer(scene);
                const GroundTruth truth = trace(tracer);
                return counted(TracedScene(tracer, truth), in_front,
                               {.projection = DepthModel::Projection::infinite, .near = value});
            },
            [](double value) {
                return fmt::format("z-pass, which loses what lies before the near plane at {:.4g}",
                                   value);
            });
    }

    void try_far_plane() {
        const double near = scene_.camera.near;
        const Counting behind{.test = Counting::Test::depth_fail, .flips = {.around_light = true}};
        search(
            "zfail_far", "far", 4 * near, 4 * traced_.far(),
            [&](double value) {
                const ShadowDepths depths = count_shadow_depths(traced_.tracer(), truth_, value);
                const DepthModel model{.near = near, .far = value};
                const VolumeStore volumes(traced_.tracer(), traced_.silhouette(), truth_, depths);
                const Prediction prediction(volumes, behind, model);
                return changed([&](std::size_t i, Visibility) {
                    return stored(prediction.counts().pixels[i], behind) == 0 && in_cone(i)
                               ? Visibility::lit
                               : Visibility::shadowed;
                });
            },
            [](double value) {
                return fmt::format("z-fail, which loses what lies past the far plane at {:.4g}",
                                   value);
            });
    }

    void try_length() {
        const Counting behind{.test = Counting::Test::depth_fail, .flips = {.around_light = true}};
        const double near = scene_.camera.near;
        search(
            "short_volumes", "length", near, 2 * traced_.far(),
            [&](double value) {
                Counting counting = behind;
                counting.extrusion = value;
                return counted(traced_, counting,
                               {.projection = DepthModel::Projection::infinite, .near = near});
            },
            [](double value) {
                return fmt::format("shadow volumes that end {:.4g} behind their casters", value);
            });
    }

    /// Steps along the axes that halve where none is better, from a tenth of the light's distance
    /// to what is seen; or, of a directional one, of its direction.
    void try_moved_light() {
        const Light& light = chosen_light(scene_);
        const bool directional = light.kind == Light::Kind::directional;
        const auto predict = [&](const glm::dvec3& by) {
            Scene moved = scene_;
            Light& other = moved.lights[moved.light];
            if (directional)
                other.direction = glm::normalize(other.direction + by);
            else
                other.position += by;
            return truth_of(moved);
        };
        const std::size_t middle =
            truth_.depth.pixels.size() / 2 + static_cast<std::size_t>(truth_.depth.width) / 2;
        const double depth = std::min(truth_.depth.pixels[middle], traced_.far());
        const glm::dvec3 point = scene_.camera.eye + depth * scene_.camera.forward;
        double step = directional ? 0.1 : 0.1 * glm::distance(point, light.position);
        glm::dvec3 by(0);
        std::int64_t score = 0;
        constexpr int rounds = 10;
        for (int round = 0; round < rounds; ++round) {
            glm::dvec3 better = by;
            for (int axis = 0; axis < 3; ++axis)
                for (const double sign : {-1.0, 1.0}) {
                    glm::dvec3 tried = by;
                    tried[axis] += sign * step;
                    const std::int64_t found = fit(predict(tried)).score();
                    if (found <= score) continue;
                    score = found;
                    better = tried;
                }
            if (better == by) step /= 2;
            by = better;
        }
        if (score > 0)
            consider(
                "light_moved", {{"x", by.x}, {"y", by.y}, {"z", by.z}}, predict(by),
                fmt::format("the light is moved by ({:.3g}, {:.3g}, {:.3g})", by.x, by.y, by.z));
    }
};

} // namespace

std::vector<Diagnosis> diagnose(const TracedScene& traced, const Frame& frame,
                                const Image<std::uint8_t>& cause) {
    return Diagnostician(traced, frame, cause).run();
}

} // namespace shadowproof
