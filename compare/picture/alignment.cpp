#include "compare/picture/alignment.h"

#include "compare/picture/predict.h"
#include "compare/picture/surface_colors.h"
#include "scenes/camera.h"
#include "scenes/surface/alpha_mask.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <map>
#include <span>

namespace shadowproof {

namespace {

using Label = std::uint32_t; ///< color_label

/// A view beside the scene's: it shows at picture point (x, y) what the scene's camera, turned and
/// zoomed, sees at (x, y) + shift. Lines of sight that are all parallel are not turned: they stay
/// in the scene's own direction, and move aside instead.
struct View {
    glm::dvec2 shift{0, 0}; ///< pixels
    double yaw = 0;         ///< radians, about the camera's up: to the left; parallel: half heights
                            ///< of the picture
    double pitch = 0;       ///< about its right: upwards; likewise
    double roll = 0;        ///< about the way it looks: counter-clockwise
    double zoom = 1;        ///< by which half the picture's height grows
};

/// The line of sight of a pixel's centre in another view: of view depth 1 in the scene's own, or
/// parallel to the scene's.
glm::dvec3 line_in(const Camera& camera, const View& view, int x, int y) {
    const bool is_parallel = camera.is_orthographic();
    const glm::dvec3 line = line_of_sight(camera, x + 0.5 + view.shift.x, y + 0.5 + view.shift.y);
    const glm::dvec3 own = is_parallel ? line - camera.eye : line;
    glm::dvec3 v(view.zoom * glm::dot(own, camera.right), view.zoom * glm::dot(own, camera.up), 1);
    const auto turn = [](double& a, double& b, double angle) {
        const double turned = std::cos(angle) * a - std::sin(angle) * b;
        b = std::sin(angle) * a + std::cos(angle) * b;
        a = turned;
    };
    turn(v.x, v.y, view.roll);
    if (is_parallel) {
        v.x -= view.yaw * camera.half_height;
        v.y += view.pitch * camera.half_height;
        return camera.eye + v.x * camera.right + v.y * camera.up;
    }
    turn(v.z, v.y, view.pitch); // forward to up
    turn(v.x, v.z, view.yaw);   // right to forward, and forward to the left
    return (v.x * camera.right + v.y * camera.up) / v.z + camera.forward;
}

struct Spot {
    int x = 0;
    int y = 0;
};

/// Of pixels that two views would show otherwise.
class Votes {
public:
    /// 1: the second view's colour is nearer, -1: the first's, 0: neither.
    void add(int vote) {
        cast_ += vote != 0 ? 1 : 0;
        sum_ += vote;
    }
    /// More for the second view than pixels at random would give it: of n that vote either way, the
    /// sum's standard deviation is the root of n, and one in three million sums is above five.
    bool are_for_second() const {
        constexpr std::int64_t deviations = 5;
        return sum_ > 0 && sum_ * sum_ > deviations * deviations * cast_;
    }
    std::int64_t sum() const { return sum_; }

private:
    std::int64_t cast_ = 0;
    std::int64_t sum_ = 0;
};

class Aligner {
public:
    Aligner(const TracedScene& traced, const Picture& picture, Shows shows)
        : traced_(traced), scene_(traced.scene()), camera_(scene_.camera), picture_(picture),
          shows_(shows), labels_(camera_.width, camera_.height) {
        for (int y = 0; y < labels_.height; ++y)
            for (int x = 0; x < labels_.width; ++x) labels_.at(x, y) = own_label(x, y);
    }

    std::optional<std::string> run() const {
        if (const auto words = mirrored()) return words;
        const std::vector<Spot> outlines = outline_spots();
        const Colors colors = colors_of(labels_);
        if (const auto words = shifted(outlines, colors)) return words;
        return std::nullopt;
    }

private:
    using Colors = std::map<Label, glm::dvec3>;

    const TracedScene& traced_;
    const Scene& scene_;
    const Camera& camera_;
    const Picture& picture_;
    Shows shows_;
    Image<Label> labels_; ///< as the scene's camera sees them

    Label own_label(int x, int y) const {
        const GroundTruth& truth = traced_.truth();
        RayTruth seen{truth.visibility.at(x, y), truth.triangle.at(x, y), truth.depth.at(x, y)};
        seen.in_cone = in_cone(truth, truth.visibility.index(x, y));
        return label_of(seen, line_of_sight(camera_, x + 0.5, y + 0.5));
    }

    Label label_of(RayTruth seen, const glm::dvec3& line) const {
        if (shows_ == Shows::no_shadows && seen.triangle != no_triangle)
            seen.visibility =
                sides_of(traced_.tracer(), seen.triangle).faces_light() && seen.in_cone
                    ? Visibility::lit
                    : Visibility::shadowed;
        return color_label(scene_, seen, line);
    }

    glm::dvec3 color(int x, int y) const {
        return color_at(picture_,
                        static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width) +
                            static_cast<std::size_t>(x));
    }

    /// Every so many pixels, so that there are 65,536 or less than twice as many along each way: a
    /// median of thousands does not change by more.
    static int step_of(const Image<Label>& labels) {
        constexpr int most_along_side = 256;
        return std::max(1, std::max(labels.width, labels.height) / most_along_side);
    }

    Colors colors_of(const Image<Label>& labels) const {
        std::map<Label, std::vector<glm::dvec3>> found;
        const int step = step_of(labels);
        for (int y = 0; y < labels.height; y += step)
            for (int x = 0; x < labels.width; x += step)
                found[labels.at(x, y)].push_back(color(x, y));
        Colors colors;
        for (auto& [label, seen] : found) colors[label] = median_color(seen);
        return colors;
    }

    /// As Votes::add takes it.
    int vote(int x, int y, const Colors& first, Label first_label, const Colors& second,
             Label second_label) const {
        const auto a = first.find(first_label);
        const auto b = second.find(second_label);
        if (first_label == second_label || a == first.end() || b == second.end()) return 0;
        const glm::dvec3 own = color(x, y);
        const double to_first = glm::distance(own, a->second);
        const double to_second = glm::distance(own, b->second);
        return to_second < to_first ? 1 : (to_first < to_second ? -1 : 0);
    }

    std::optional<std::string> mirrored() const {
        struct Flip {
            bool x;
            bool y;
            const char* words;
        };
        const Colors own = colors_of(labels_);
        std::optional<std::string> words;
        std::int64_t most = 0;
        for (const Flip& flip :
             {Flip{true, false, "is mirrored left to right"}, Flip{false, true, "is upside down"},
              Flip{true, true, "is turned by half"}}) {
            Image<Label> flipped(labels_.width, labels_.height);
            for (int y = 0; y < labels_.height; ++y)
                for (int x = 0; x < labels_.width; ++x)
                    flipped.at(x, y) = labels_.at(flip.x ? labels_.width - 1 - x : x,
                                                  flip.y ? labels_.height - 1 - y : y);
            const Colors colors = colors_of(flipped);
            Votes votes;
            const int step = step_of(labels_);
            for (int y = 0; y < labels_.height; y += step)
                for (int x = 0; x < labels_.width; x += step)
                    votes.add(vote(x, y, own, labels_.at(x, y), colors, flipped.at(x, y)));
            if (!votes.are_for_second() || votes.sum() <= most) continue;
            most = votes.sum();
            words = flip.words;
        }
        return words;
    }

    /// Pixels beside which another mesh, or the background, begins: spread evenly, some thousands.
    /// Outlines of holes in alpha masks are none: a picture that ignores masks has others there,
    /// and is not another view.
    std::vector<Spot> outline_spots() const {
        constexpr std::size_t most = 8192;
        const Image<std::uint32_t>& triangles = traced_.truth().triangle;
        const auto mesh = [&](int x, int y) {
            const std::uint32_t triangle = triangles.at(x, y);
            return triangle == no_triangle ? no_triangle : mesh_of(scene_, triangle);
        };
        Image<std::uint32_t> whole; // what is seen without masks
        if (has_masks(scene_)) {
            const Scene without = without_masks(scene_);
            whole = trace(Tracer(without, traced_.tracer().threads())).triangle;
        }
        const auto near_hole = [&](int x, int y) {
            constexpr int reach = 2; // views move outlines by a pixel, and by more in the end
            if (whole.pixels.empty()) return false;
            for (int v = std::max(y - reach, 0); v <= std::min(y + reach, whole.height - 1); ++v)
                for (int u = std::max(x - reach, 0); u <= std::min(x + reach, whole.width - 1); ++u)
                    if (whole.at(u, v) != triangles.at(u, v)) return true;
            return false;
        };
        std::vector<Spot> all;
        for (int y = 1; y + 1 < triangles.height; ++y)
            for (int x = 1; x + 1 < triangles.width; ++x) {
                const std::uint32_t own = mesh(x, y);
                if ((mesh(x - 1, y) != own || mesh(x + 1, y) != own || mesh(x, y - 1) != own ||
                     mesh(x, y + 1) != own) &&
                    !near_hole(x, y))
                    all.push_back({x, y});
            }
        const std::size_t step = std::max<std::size_t>(1, all.size() / most);
        std::vector<Spot> some;
        for (std::size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
        return some;
    }

    std::vector<Label> labels_in(const View& view, std::span<const Spot> spots) const {
        std::vector<glm::dvec3> lines;
        lines.reserve(spots.size());
        for (const Spot& spot : spots) lines.push_back(line_in(camera_, view, spot.x, spot.y));
        const std::vector<RayTruth> seen = trace_rays(traced_.tracer(), lines);
        std::vector<Label> labels;
        for (std::size_t i = 0; i < seen.size(); ++i) labels.push_back(label_of(seen[i], lines[i]));
        return labels;
    }

    Votes votes_for(const View& view, std::span<const Spot> spots, const Colors& colors) const {
        const std::vector<Label> labels = labels_in(view, spots);
        Votes votes;
        for (std::size_t i = 0; i < spots.size(); ++i)
            votes.add(vote(spots[i].x, spots[i].y, colors, labels_.at(spots[i].x, spots[i].y),
                           colors, labels[i]));
        return votes;
    }

    /// Views that move outlines by a pixel or half of one: a picture whose outlines lie elsewhere
    /// is nearer to one of them.
    std::optional<std::string> shifted(const std::vector<Spot>& outlines,
                                       const Colors& colors) const {
        View half;
        std::int64_t most = 0;
        const auto look = [&](const View& view) {
            const Votes votes = votes_for(view, outlines, colors);
            if (!votes.are_for_second() || votes.sum() <= most) return false;
            most = votes.sum();
            return true;
        };
        for (const double x : {-0.5, 0.0, 0.5})
            for (const double y : {-0.5, 0.0, 0.5})
                if (const View view{.shift = {x, y}}; (x != 0 || y != 0) && look(view)) half = view;
        bool further = false;
        for (const double x : {-1.0, 0.0, 1.0})
            for (const double y : {-1.0, 0.0, 1.0})
                if (x != 0 || y != 0) further = look({.shift = {x, y}}) || further;
        // As much as moves the picture's border by a pixel.
        const double border = 2.0 / std::max(camera_.width, camera_.height);
        for (const double sign : {-1.0, 1.0}) {
            further = look({.roll = sign * border}) || further;
            further = look({.zoom = 1 + sign * border}) || further;
        }
        if (further)
            if (const auto words = fitted()) return words;
        if (half.shift == glm::dvec2(0)) return std::nullopt;
        return fmt::format(
            "is shifted by about half a pixel{}{}: its pixels' centres are not those "
            "of the view",
            half.shift.x == 0  ? ""
            : half.shift.x > 0 ? " to the left"
                               : " to the right",
            half.shift.y == 0  ? ""
            : half.shift.y > 0 ? " up"
                               : " down");
    }

    /// How far colours lie from the median of their labels, in all: least where outlines fit.
    double scatter(const View& view, std::span<const Spot> spots) const {
        const std::vector<Label> labels = labels_in(view, spots);
        std::map<Label, std::vector<glm::dvec3>> found;
        for (std::size_t i = 0; i < spots.size(); ++i)
            found[labels[i]].push_back(color(spots[i].x, spots[i].y));
        double sum = 0;
        for (auto& [label, seen] : found) {
            const glm::dvec3 median = median_color(seen);
            for (const glm::dvec3& each : seen) sum += glm::distance(each, median);
        }
        return sum;
    }

    /// Steps that halve where none is better, from some degrees to less than half a pixel.
    std::optional<std::string> fitted() const {
        constexpr int along_side = 128;
        std::vector<Spot> spots;
        const int step = std::max(1, std::max(camera_.width, camera_.height) / along_side);
        for (int y = step / 2; y < camera_.height; y += step)
            for (int x = step / 2; x < camera_.width; x += step) spots.push_back({x, y});
        // At depth 1, or of half heights.
        const double pixel =
            (camera_.is_orthographic() ? 2 : 2 * half_extent(camera_).y) / camera_.height;
        View best;
        double least = scatter(best, spots);
        for (double turn = 0.064; turn > 0.25 * pixel;) {
            const View from = best;
            const auto look = [&](const View& view) {
                const double found = scatter(view, spots);
                if (!(found < least)) return;
                least = found;
                best = view;
            };
            for (const double by : {-turn, turn}) {
                View view = from;
                view.yaw += by;
                look(view);
                view = from;
                view.pitch += by;
                look(view);
                view = from;
                view.roll += by;
                look(view);
                view = from;
                view.zoom *= 1 + by;
                look(view);
            }
            const bool same = best.yaw == from.yaw && best.pitch == from.pitch &&
                              best.roll == from.roll && best.zoom == from.zoom;
            if (same) turn /= 2;
        }
        return words_of(best, pixel);
    }

    /// Names what moves something in the picture by more than half a pixel.
    std::optional<std::string> words_of(const View& view, double pixel) const {
        if (camera_.is_orthographic()) return words_of_parallel(view, pixel);
        const glm::dvec2 half = half_extent(camera_);
        const double border = std::max(half.x, half.y);
        std::string words;
        const auto add = [&](const std::string& what) {
            words += (words.empty() ? "" : "; ") + what;
        };
        if (std::abs(view.zoom - 1) * border > 0.5 * pixel)
            add(fmt::format("has a field of view of {:.2f} degrees, the scene's is {:.2f}",
                            glm::degrees(2 * std::atan(view.zoom * half.y)),
                            glm::degrees(2 * std::atan(half.y))));
        const auto add_turn = [&](double angle, double moved, const char* about) {
            if (std::abs(moved) > 0.5 * pixel)
                add(fmt::format("its camera is turned by {:.2f} degrees about {}",
                                glm::degrees(angle), about));
        };
        add_turn(view.yaw, view.yaw, "its up axis");
        add_turn(view.pitch, view.pitch, "its right axis");
        add_turn(view.roll, view.roll * border, "the way it looks");
        return words.empty() ? std::nullopt : std::optional(words);
    }

    std::optional<std::string> words_of_parallel(const View& view, double pixel) const {
        const double height = 2 * camera_.half_height * scene_.unit;
        const double border = std::max(1.0, static_cast<double>(camera_.width) / camera_.height);
        std::string words;
        const auto add = [&](double moved, const std::string& what) {
            if (std::abs(moved) > 0.5 * pixel) words += (words.empty() ? "" : "; ") + what;
        };
        add((view.zoom - 1) * border, fmt::format("shows {:.5g} from top to bottom, the scene's "
                                                  "camera {:.5g}",
                                                  view.zoom * height, height));
        const auto moved = [&](double by, const char* positive, const char* negative) {
            return fmt::format("its camera is {:.5g} too far {}", std::abs(by) * 0.5 * height,
                               by > 0 ? positive : negative);
        };
        add(view.yaw, moved(view.yaw, "to the left", "to the right"));
        add(view.pitch, moved(view.pitch, "up", "down"));
        add(view.roll * border, fmt::format("its camera is turned by {:.2f} degrees about the way "
                                            "it looks",
                                            glm::degrees(view.roll)));
        return words.empty() ? std::nullopt : std::optional(words);
    }
};

} // namespace

std::optional<std::string> misalignment(const TracedScene& traced, const Picture& picture,
                                        Shows shows) {
    return Aligner(traced, picture, shows).run();
}

} // namespace shadowproof
