#include "compare/driver/neighbourhood.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <set>

namespace shadowproof {

Neighbourhood neighbourhood(const Camera& camera, const glm::dvec2& centre,
                            const BandRadius& radius) {
    constexpr std::array<double, 5> steps{0, -1, 1, -0.5, 0.5};
    Neighbourhood around;
    const auto ray = [&](double right, double down) {
        return line_of_sight(camera, centre.x + right, centre.y + down);
    };
    const auto add = [&](double reach) {
        for (std::size_t i = 1; i < steps.size() * steps.size(); ++i)
            around.rays.push_back(
                ray(reach * steps[i % steps.size()], reach * steps[i / steps.size()]));
    };
    around.rays.push_back(ray(0, 0));
    if (radius.surface > 0) add(radius.surface);
    if (radius.nearest > radius.surface) add(radius.nearest);
    const double reach = std::max(radius.surface, radius.nearest);
    around.reach = reach;
    around.corners = {ray(-reach, -reach), ray(reach, -reach), ray(reach, reach),
                      ray(-reach, reach)};
    return around;
}

namespace {

/// A plane through the eye as a line over the neighbourhood, whose corners are (-1, -1) to (1, 1):
/// the signed distance of a place is dot(normal, place) + offset.
struct Line {
    glm::dvec2 normal{0, 0};
    double offset = 0;

    double distance(const glm::dvec2& place) const { return glm::dot(normal, place) + offset; }
};

std::vector<Line> lines_of(const std::vector<SightPlane>& planes, const glm::dvec3& centre,
                           const glm::dvec3& right, const glm::dvec3& down) {
    std::vector<Line> lines;
    for (const SightPlane& plane : planes) {
        const glm::dvec2 normal(glm::dot(plane.normal, right), glm::dot(plane.normal, down));
        const double length = glm::length(normal);
        if (length > 0) lines.push_back({normal / length, plane.side(centre) / length});
    }
    return lines;
}

/// Where the line crosses the square and the other lines, as places along it in order.
std::vector<double> stops_along(const Line& line, const std::vector<Line>& lines) {
    const glm::dvec2 foot = -line.offset * line.normal;
    const glm::dvec2 along(-line.normal.y, line.normal.x);
    double begin = -2; // further from the foot than any place in the square
    double end = 2;
    for (int axis = 0; axis < 2; ++axis) {
        if (along[axis] == 0 && std::abs(foot[axis]) >= 1) return {};
        if (along[axis] == 0) continue;
        const double one = (-1 - foot[axis]) / along[axis];
        const double other = (1 - foot[axis]) / along[axis];
        begin = std::max(begin, std::min(one, other));
        end = std::min(end, std::max(one, other));
    }
    if (begin >= end) return {};
    std::vector<double> stops{begin, end};
    for (const Line& other : lines) {
        const double stop = -other.distance(foot) / glm::dot(other.normal, along);
        if (stop > begin && stop < end) stops.push_back(stop);
    }
    std::sort(stops.begin(), stops.end());
    return stops;
}

} // namespace

void read_masks_in_all_ways(Neighbourhood& around) {
    const std::vector<glm::dvec3> rays = around.rays;
    around.readings.assign(rays.size(), MaskReading::exact);
    for (const MaskReading reading : {MaskReading::most, MaskReading::least}) {
        around.rays.insert(around.rays.end(), rays.begin(), rays.end());
        around.readings.insert(around.readings.end(), rays.size(), reading);
    }
}

// Each part that lies next to a line has a piece of it as a side, from one crossing to the next.
// From the piece's middle, half the way to the nearest of all other lines leads into that part.
std::vector<glm::dvec3> rays_between(const Neighbourhood& around,
                                     const std::vector<SightPlane>& planes) {
    constexpr std::size_t most_lines = 12;
    const glm::dvec3& centre = around.rays.front();
    const glm::dvec3 right = 0.5 * (around.corners[1] - around.corners[0]);
    const glm::dvec3 down = 0.5 * (around.corners[3] - around.corners[0]);
    std::vector<Line> lines = lines_of(planes, centre, right, down);
    std::stable_sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) {
        return std::abs(a.offset) < std::abs(b.offset);
    });
    if (lines.size() > most_lines) lines.resize(most_lines);

    std::vector<glm::dvec3> rays;
    std::set<std::vector<bool>> parts; // by the sides of the lines on which they lie
    const auto add = [&](const glm::dvec2& place) {
        std::vector<bool> part;
        for (const Line& line : lines) part.push_back(line.distance(place) < 0);
        if (parts.insert(part).second) rays.push_back(centre + place.x * right + place.y * down);
    };
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const Line& line = lines[i];
        const std::vector<double> stops = stops_along(line, lines);
        for (std::size_t k = 1; k < stops.size(); ++k) {
            const glm::dvec2 middle =
                -line.offset * line.normal +
                0.5 * (stops[k - 1] + stops[k]) * glm::dvec2(-line.normal.y, line.normal.x);
            double room = 1;
            for (std::size_t j = 0; j < lines.size(); ++j)
                if (j != i) room = std::min(room, std::abs(lines[j].distance(middle)));
            for (int axis = 0; axis < 2; ++axis) room = std::min(room, 1 - std::abs(middle[axis]));
            add(middle + 0.5 * room * line.normal);
            add(middle - 0.5 * room * line.normal);
        }
    }
    return rays;
}

SeenAround seen_around(const Neighbourhood& around, std::span<const RayTruth> truth,
                       Visibility visibility) {
    SeenAround seen;
    for (std::size_t i = 0; i < truth.size(); ++i)
        if (truth[i].visibility == visibility)
            (around.is_moved(i) ? seen.by_planes : seen.truly) = true;
    return seen;
}

double spread(const Neighbourhood& around) {
    double largest = 0;
    for (const glm::dvec3& corner : around.corners) {
        const glm::dvec3 apart = glm::abs(corner - around.rays.front());
        largest = std::max({largest, apart.x, apart.y, apart.z});
    }
    return largest;
}

bool may_cover(const Scene& scene, std::uint32_t triangle, const glm::dvec3& line, double error) {
    const Camera& camera = scene.camera;
    const glm::dvec3& start = start_of(camera, line);
    const glm::dvec3& direction = direction_of(camera, line);
    const bool is_parallel = camera.is_orthographic();
    const glm::dvec3 a = corner(scene, triangle, 0) - start;
    const glm::dvec3 b = corner(scene, triangle, 1) - start;
    const glm::dvec3 c = corner(scene, triangle, 2) - start;
    const double side =
        is_parallel ? glm::dot(direction, glm::cross(b - a, c - a)) : glm::dot(a, glm::cross(b, c));
    const double facing = side < 0 ? -1 : 1;
    const auto inside = [&](const glm::dvec3& from, const glm::dvec3& to) {
        const glm::dvec3 plane = facing * glm::cross(from, to);
        // What the line changes by, where it is off: its start moves against the edge.
        const glm::dvec3 size = glm::abs(is_parallel ? glm::cross(direction, to - from) : plane);
        return glm::dot(direction, plane) >= -error * (size.x + size.y + size.z);
    };
    return inside(a, b) && inside(b, c) && inside(c, a);
}

namespace {

/// Triangles with two corners in common meet without a gap wherever those are moved to.
bool share_an_edge(const Scene& scene, std::uint32_t one, std::uint32_t other) {
    int shared = 0;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            shared += corner(scene, one, i) == corner(scene, other, k) ? 1 : 0;
    return shared >= 2;
}

/// Removes one triangle, and all that are connected with it, from `triangles`, which is not empty.
std::vector<std::uint32_t> take_group(const Scene& scene, std::vector<std::uint32_t>& triangles) {
    std::vector<std::uint32_t> group{triangles.back()};
    triangles.pop_back();
    for (std::size_t i = 0; i < group.size(); ++i) {
        const auto apart =
            std::partition(triangles.begin(), triangles.end(), [&](std::uint32_t triangle) {
                return !share_an_edge(scene, group[i], triangle);
            });
        group.insert(group.end(), apart, triangles.end());
        triangles.erase(apart, triangles.end());
    }
    return group;
}

} // namespace

bool may_gape(const Scene& scene, std::vector<std::uint32_t> triangles,
              std::span<const glm::dvec3> rays) {
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    int groups = 0;
    for (; !triangles.empty(); ++groups) {
        const std::vector<std::uint32_t> group = take_group(scene, triangles);
        const bool covers = std::ranges::all_of(rays, [&](const glm::dvec3& ray) {
            return std::ranges::any_of(
                group, [&](std::uint32_t triangle) { return may_cover(scene, triangle, ray, 0); });
        });
        if (covers) return false;
    }
    return groups > 1;
}

} // namespace shadowproof
