#include "tests/claims/reach_claims.h"

#include "compare/picture/predict.h"
#include "compare/stencil/figures/face_counts.h"
#include "raster/render.h"
#include "scenes/camera.h"
#include "scenes/load/catalog.h"
#include "tests/compare/traced_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace shadowproof::claims {

namespace {

struct Span {
    double least = -std::numeric_limits<double>::infinity();
    double most = std::numeric_limits<double>::infinity();

    bool holds(double value) const { return value >= least && value <= most; }
};

/// The slopes, across over along, of rays from the origin forwards that meet a circle.
Span slopes_of_circle(double across, double along, double radius) {
    const double distance = std::hypot(across, along);
    if (distance <= radius) return {};
    const double middle = std::atan2(across, along);
    const double half = std::asin(radius / distance);
    constexpr double quarter = std::numbers::pi / 2;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto slope = [&](double angle) {
        if (angle >= quarter) return infinity;
        return angle <= -quarter ? -infinity : std::tan(angle);
    };
    return {slope(middle - half), slope(middle + half)};
}

/// Where a light reaches: the least rectangle of the picture around its sphere (Lengyel 2002), and
/// the sphere's depths along the view.
struct Reach {
    Span columns; ///< slopes to the right
    Span rows;    ///< slopes upwards
    Span depths;
};

Reach reach_of(const glm::dvec3& light, double range) {
    return {slopes_of_circle(light.x, -light.z, range),
            slopes_of_circle(light.y, -light.z, range),
            {-light.z - range, -light.z + range}};
}

/// Faces of all volumes at each pixel, hidden or not.
Image<std::int32_t> faces_at(const tests::TracedScene& there, Frame frame) {
    std::ranges::fill(frame.depth.pixels, 0.0F); // of reversed depths, as far as can be
    std::ranges::fill(frame.triangle.pixels, no_triangle);
    const Volumes volumes(there.tracer, there.silhouette, frame.counted->counting);
    const DrawnFaces faces =
        drawn_faces(volumes, frame.counted->counting, frame.counted->volume_faces);
    return count_faces(
               {volumes.drawn_casters(), volumes.far_ends(), faces, frame, there.depths.far},
               there.tracer.threads())
        .high;
}

/// Fragments that are left, of all that are tested.
struct Left {
    std::uint64_t by_scissor = 0;
    std::uint64_t by_bounds = 0; ///< by both
    std::uint64_t in_reach = 0;  ///< where what is seen is within the sphere
    std::uint64_t all = 0;
};

Left left_of(const tests::TracedScene& there, const Image<std::int32_t>& faces, double range) {
    const Camera& camera = there.scene.camera;
    const glm::dmat3 view = view_from_eye_relative(camera);
    const glm::dvec3 light = view * (chosen_light(there.scene).position - camera.eye);
    const Reach reach = reach_of(light, range);
    Left left;
    for (int y = 0; y < faces.height; ++y)
        for (int x = 0; x < faces.width; ++x) {
            const auto count = static_cast<std::uint64_t>(faces.at(x, y));
            left.all += count;
            const glm::dvec3 ray = view * line_of_sight(camera, x + 0.5, y + 0.5);
            const bool in_rectangle =
                reach.columns.holds(ray.x / -ray.z) && reach.rows.holds(ray.y / -ray.z);
            if (in_rectangle) left.by_scissor += count;
            if (there.truth.triangle.at(x, y) == no_triangle) continue;
            const glm::dvec3 seen = view * (seen_point(there.traced, x, y) - camera.eye);
            const bool in_bounds = in_rectangle && reach.depths.holds(-seen.z);
            if (in_bounds) left.by_bounds += count;
            if (glm::distance(seen, light) > range) continue;
            if (!in_bounds) throw std::logic_error("bounds leave out what the light reaches");
            left.in_reach += count;
        }
    return left;
}

/// The distances from the light to all that is seen, in growing order.
std::vector<double> distances_seen(const tests::TracedScene& there) {
    std::vector<double> distances;
    for (int y = 0; y < there.truth.triangle.height; ++y)
        for (int x = 0; x < there.truth.triangle.width; ++x)
            if (there.truth.triangle.at(x, y) != no_triangle)
                distances.push_back(glm::distance(seen_point(there.traced, x, y),
                                                  chosen_light(there.scene).position));
    std::ranges::sort(distances);
    return distances;
}

} // namespace

std::vector<Section> reach_claims() {
    Gpu gpu(GlPlatform::osmesa);
    constexpr std::array shares{1.0, 0.5, 0.25, 0.0625};
    std::string text =
        "VGP353 names depth bounds among the \"hardware based optimizations\", and Lengyel (2002)\n"
        "cuts volumes by the rectangle around what the light reaches (scissor). Both leave out\n"
        "fragments before the stencil is touched, of lights that end: at pixels outside that\n"
        "rectangle, and at pixels whose surface lies nearer or farther than the light's sphere.\n"
        "Of the fragments of `zfail_reversed`, what the rectangle leaves, what both leave, and "
        "what\n"
        "is needed, as the surface there is within the sphere; if the light reached all surfaces\n"
        "that are seen, or half of the pixels, or fewer:\n\n"
        "| scene | fragments | all | 1/2 | 1/4 | 1/16 |\n"
        "|---|---|---|---|---|---|\n";
    for (const char* name : {"ordinary", "overlapping", "near_plane", "eye_inside", "idle_casters",
                             "long_shadow", "walking_figure"}) {
        const tests::TracedScene there(load_scene(name, {}));
        const Frame frame = render(*find_technique("zfail_reversed"), there.scene, there.plan, gpu);
        const Image<std::int32_t> faces = faces_at(there, frame);
        const std::vector<double> distances = distances_seen(there);
        text += fmt::format("| {} | {} |", there.scene.name, frame.counted->volume_fragments);
        for (const double share : shares) {
            const auto last = static_cast<double>(distances.size() - 1);
            const Left left =
                left_of(there, faces, distances[static_cast<std::size_t>(share * last)]);
            const auto percent = [&](std::uint64_t count) {
                return 100 * static_cast<double>(count) / static_cast<double>(left.all);
            };
            text += fmt::format(" {:.0f}, {:.0f}, {:.0f} % |", percent(left.by_scissor),
                                percent(left.by_bounds), percent(left.in_reach));
        }
        text += "\n";
    }
    text +=
        "\nDepth bounds leave out the sky, to which volumes run, under any light. Where a light\n"
        "reaches half of the picture, both leave about half of the fragments on most scenes, "
        "twice\n"
        "what is needed: the box around a sphere is larger than what surfaces cut out of it. The\n"
        "smaller the reach the more the rectangle saves. Nothing that the light reaches is left\n"
        "out, at any pixel.\n";
    return {{"Scissor and depth bounds save where the light ends", text, ""}};
}

} // namespace shadowproof::claims
