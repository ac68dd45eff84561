#include "reference/trace/shells.h"

#include "reference/trace/state.h"
#include "scenes/mesh/topology.h"
#include "scenes/roundoff.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <tuple>
#include <utility>

namespace shadowproof {

namespace {

constexpr std::uint32_t none = 0xffffffffU;

/// Sides of the casters' triangles, three per triangle, and for each its twin, which runs the same
/// edge the other way. Where several run an edge, they are paired in the order of the triangles:
/// the first that runs it one way with the first that runs it the other way, the second with the
/// second.
struct Sides {
    std::vector<std::uint32_t> triangle; ///< of side 3 i + k: the i-th that has an area
    std::vector<std::uint32_t> corner;   ///< where a side begins: welded position index
    std::vector<std::uint32_t> twin;     ///< none on a boundary

    static std::uint32_t next(std::uint32_t side) { return side % 3 == 2 ? side - 2 : side + 1; }
};

void pair_sides(Sides& sides) {
    struct Run {
        std::uint32_t low, high;
        bool up;
        std::uint32_t side;
    };
    std::vector<Run> runs(sides.corner.size());
    for (std::uint32_t side = 0; side < runs.size(); ++side) {
        const std::uint32_t a = sides.corner[side];
        const std::uint32_t b = sides.corner[Sides::next(side)];
        runs[side] = {std::min(a, b), std::max(a, b), a < b, side};
    }
    std::sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) {
        return std::tie(a.low, a.high, a.up, a.side) < std::tie(b.low, b.high, b.up, b.side);
    });
    sides.twin.assign(runs.size(), none);
    for (auto down = runs.begin(); down != runs.end();) {
        const auto end = std::find_if(down, runs.end(), [&](const Run& run) {
            return run.low != down->low || run.high != down->high;
        });
        auto up = std::find_if(down, end, [](const Run& run) { return run.up; });
        const auto last_down = up;
        for (; down != last_down && up != end; ++down, ++up) {
            sides.twin[down->side] = up->side;
            sides.twin[up->side] = down->side;
        }
        down = end;
    }
}

Sides sides_of_casters(const Scene& scene) {
    const std::vector<std::uint8_t> casts = casting_triangles(scene);
    const std::vector<std::uint32_t> welded = weld_by_position(scene.positions);
    Sides sides;
    for (std::uint32_t triangle = 0; triangle < scene.triangles.size(); ++triangle) {
        if (casts[triangle] == 0) continue;
        const glm::uvec3& t = scene.triangles[triangle];
        const std::array<std::uint32_t, 3> corners{welded[t.x], welded[t.y], welded[t.z]};
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
            continue;
        sides.triangle.push_back(triangle);
        sides.corner.insert(sides.corner.end(), corners.begin(), corners.end());
    }
    pair_sides(sides);
    return sides;
}

/// Whether the signed volume is negative beyond rounding: each triangle's share of it, a triple
/// product of differences, is off by less than 16 roundings of the product of their lengths, and
/// the sum of n of them by less than n roundings of all together.
bool is_inverted(const Scene& scene, std::span<const std::uint32_t> triangles) {
    const glm::dvec3 origin = corner(scene, triangles.front(), 0);
    double volume = 0;
    double size = 0;
    for (const std::uint32_t triangle : triangles) {
        std::array<glm::dvec3, 3> v{};
        for (int k = 0; k < 3; ++k)
            v[static_cast<std::size_t>(k)] = corner(scene, triangle, k) - origin;
        volume += glm::dot(glm::cross(v[0], v[1]), v[2]);
        size += glm::length(v[0]) * glm::length(v[1]) * glm::length(v[2]);
    }
    return volume < -(16 + static_cast<double>(triangles.size())) * double_roundoff * size;
}

/// Whether the triangles of a closed shell, as seen from the light, cover more of the sky by their
/// backs than by their fronts. From inside they cover all of it, 4 pi; from a point on the shell a
/// part; from outside what rounding leaves, a few 2^-53 per triangle: less than the limit even for
/// 10^9 of them. The solid angle of a triangle with unit directions u, v, w to its corners has the
/// tangent (u . v x w) / (1 + u . v + v . w + w . u) of its half; its sign is exact, because next
/// to the light it tells which half of the sky the triangle covers.
bool holds_light(const Scene& scene, std::span<const std::uint32_t> triangles) {
    const Light& light = chosen_light(scene);
    if (light.kind == Light::Kind::directional) return false;
    constexpr double limit = 0x1p-20;
    double half_covered = 0;
    for (const std::uint32_t triangle : triangles) {
        std::array<glm::dvec3, 3> to{};
        std::array<double, 3> far{};
        for (std::size_t k = 0; k < 3; ++k) {
            to[k] = corner(scene, triangle, static_cast<int>(k)) - light.position;
            far[k] = glm::length(to[k]);
        }
        // Multiplied by all three lengths, so that a corner in the light causes no division by
        // zero.
        const double fronts = side(scene, triangle, homogeneous(light));
        const double size = std::abs(glm::dot(glm::cross(to[0], to[1]), to[2]));
        const double tangent = fronts == 0 ? 0 : std::copysign(size, -fronts);
        const double one = far[0] * far[1] * far[2] + far[2] * glm::dot(to[0], to[1]) +
                           far[0] * glm::dot(to[1], to[2]) + far[1] * glm::dot(to[2], to[0]);
        half_covered += std::atan2(tangent, one);
    }
    return half_covered > limit;
}

/// From a side without a twin around the triangles at its end to the one that leaves from there.
std::uint32_t next_on_boundary(const Sides& sides, std::uint32_t side) {
    std::uint32_t leaving = Sides::next(side);
    while (sides.twin[leaving] != none) leaving = Sides::next(sides.twin[leaving]);
    return leaving;
}

void add_fan(std::span<const std::uint32_t> ring, std::vector<glm::uvec3>& lids) {
    for (std::size_t i = 1; i + 1 < ring.size(); ++i)
        lids.emplace_back(ring[0], ring[i + 1], ring[i]); // against the triangles' own direction
}

} // namespace

Shells find_shells(const Scene& scene) {
    const Sides sides = sides_of_casters(scene);
    Shells shells;
    shells.triangles.reserve(sides.triangle.size());
    std::vector<std::uint8_t> is_reached(sides.triangle.size(), 0);
    std::vector<std::uint32_t> reached;
    for (std::uint32_t first = 0; first < is_reached.size(); ++first) {
        if (is_reached[first] != 0) continue;
        Shell& shell = shells.all.emplace_back();
        shell.first = shells.triangles.size();
        is_reached[first] = 1;
        reached.assign(1, first);
        while (!reached.empty()) {
            const std::uint32_t at = reached.back();
            reached.pop_back();
            shells.triangles.push_back(sides.triangle[at]);
            for (std::uint32_t side = 3 * at; side < 3 * at + 3; ++side) {
                const std::uint32_t twin = sides.twin[side];
                shell.closed = shell.closed && twin != none;
                if (twin == none || is_reached[twin / 3] != 0) continue;
                is_reached[twin / 3] = 1;
                reached.push_back(twin / 3);
            }
        }
        shell.count = shells.triangles.size() - shell.first;
        std::sort(shells.triangles.begin() + static_cast<std::ptrdiff_t>(shell.first),
                  shells.triangles.end());
        shell.inverted = shell.closed && is_inverted(scene, shells.of(shell));
        shell.holds_light = shell.closed && holds_light(scene, shells.of(shell));
    }
    return shells;
}

std::vector<std::uint8_t> flipped_triangles(const Tracer& tracer, Counting::Flips flips) {
    using Averted = Counting::Flips::Averted;
    if (flips == Counting::Flips{}) return {};
    const Tracer::State& state = tracer.state();
    std::vector<std::uint8_t> flags;
    const auto flip = [&](std::uint32_t triangle) {
        flags.resize(state.scene->triangles.size(), 0);
        flags[triangle] = 1;
    };
    const Shells& shells = state.shells.get(*state.scene);
    for (const Shell& shell : shells.all) {
        const bool faulty = !shell.closed || shell.inverted;
        const bool each_by_itself =
            faulty ? flips.averted != Averted::none
                   : flips.averted == Averted::of_all_shells && !shell.holds_light;
        for (const std::uint32_t triangle : shells.of(shell))
            if (each_by_itself ? state.side_of_light[triangle] > 0
                               : flips.around_light && shell.holds_light)
                flip(triangle);
    }
    return flags;
}

std::vector<glm::uvec3> lids_of(const Scene& scene) {
    const Sides sides = sides_of_casters(scene);
    std::vector<glm::uvec3> lids;
    std::vector<std::uint8_t> walked(sides.corner.size(), 0);
    std::vector<std::uint32_t> path;
    std::vector<std::uint32_t> place(scene.positions.size(), none); // of each corner in the path
    for (std::uint32_t start = 0; start < walked.size(); ++start) {
        if (sides.twin[start] != none || walked[start] != 0) continue;
        path.clear();
        for (std::uint32_t side = start; walked[side] == 0; side = next_on_boundary(sides, side)) {
            walked[side] = 1;
            const std::uint32_t corner = sides.corner[side];
            if (place[corner] != none) {
                const std::size_t since = place[corner];
                add_fan(std::span(path).subspan(since), lids);
                for (std::size_t i = since; i < path.size(); ++i) place[path[i]] = none;
                path.resize(since);
            }
            place[corner] = static_cast<std::uint32_t>(path.size());
            path.push_back(corner);
        }
        add_fan(path, lids);
        for (const std::uint32_t corner : path) place[corner] = none;
    }
    return lids;
}

} // namespace shadowproof
