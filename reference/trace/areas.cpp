#include "reference/trace/areas.h"

#include "reference/parallel.h"
#include "reference/trace/state.h"
#include "reference/trace/view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

namespace shadowproof {

namespace {

/// For so many pixels that are asked for a triangle is worth looking at in a square, and in a block
/// pixel by pixel: for fewer, rays are quicker (shadowproof_verify_bench).
constexpr std::size_t pixels_for_a_triangle = 8;
constexpr std::size_t block_pixels_for_a_triangle = 2;

/// Bounds rounding errors that are counted in the comments: none is more than 2^7 roundings of
/// 2^-53 of the magnitudes that it is multiplied by.
constexpr double roundings = 0x1p-46;

glm::dvec3 absolute_cross(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 p = glm::abs(a);
    const glm::dvec3 q = glm::abs(b);
    return {p.y * q.z + p.z * q.y, p.z * q.x + p.x * q.z, p.x * q.y + p.y * q.x};
}

double sum(const glm::dvec3& v) {
    return v.x + v.y + v.z;
}

/// A linear function of rays' directions, and how far it may be off for each unit of a direction's
/// largest component.
struct Linear {
    glm::dvec3 gradient{0, 0, 0};
    double error = std::numeric_limits<double>::infinity();
};

/// A triangle whose side towards the eye is drawn, with corners a, b, c relative to the eye, as
/// functions of a ray's direction. A ray meets it where all edges are positive, and its plane at
/// the inverse of `inverse`.
struct SeenTriangle {
    std::uint32_t triangle = no_triangle;
    bool is_solid = true; ///< no mask lets light through
    std::array<Linear, 3> edges;
    Linear inverse;
};

/// Differences of corners are off by a rounding; a component of a cross product, which is two
/// products of such, by 3 of the sum of their sizes and one more; and so is its product with a
/// direction by 4 of the sum of all components. A direction within a square is a sum of three
/// vectors, off by 8 of its largest component. In all less than 32.
Linear edge_between(const glm::dvec3& a, const glm::dvec3& b, double sign) {
    return {sign * glm::cross(a, b), roundings * sum(absolute_cross(a, b))};
}

/// n / dot(n, a), for the normal n = (b - a) x (c - a), which is off by 4 roundings of the sizes of
/// its products, s; their dot product with a corner by 10 of s times that. Nothing is known where
/// that is not far less than the product: the eye lies nearly in the plane.
Linear inverse_of_plane(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double product = glm::dot(normal, a);
    const double size = sum(absolute_cross(b - a, c - a));
    const double share = roundings * size * sum(glm::abs(a)) / std::abs(product);
    if (!(share < 0x1p-10)) return {};
    return {normal / product, (roundings + 2 * share) * size / std::abs(product)};
}

std::optional<SeenTriangle> seen_triangle(const Tracer& tracer, std::uint32_t triangle) {
    const TriangleSides sides = sides_of(tracer, triangle);
    if (!sides.visible) return std::nullopt; // also where the eye lies in its plane
    const Tracer::State& state = tracer.state();
    const Corners t = corners(*state.scene, triangle);
    const glm::dvec3 a = t.a - state.scene->camera.eye;
    const glm::dvec3 b = t.b - state.scene->camera.eye;
    const glm::dvec3 c = t.c - state.scene->camera.eye;
    const double sign = sides.front_to_eye ? -1 : 1;
    return SeenTriangle{
        triangle,
        !state.has_mask(triangle),
        {edge_between(a, b, sign), edge_between(b, c, sign), edge_between(c, a, sign)},
        inverse_of_plane(a, b, c)};
}

/// The directions of the rays through the centres of a rectangle's pixels.
struct Directions {
    glm::dvec3 centre{0, 0, 0};
    glm::dvec3 half_width{0, 0, 0};
    glm::dvec3 half_height{0, 0, 0};
    double largest = 0; ///< no component of one is larger

    struct Range {
        double least = 0;
        double most = 0;
    };
    /// Of a linear function, with its error.
    Range of(const Linear& linear) const {
        const double middle = glm::dot(linear.gradient, centre);
        const double around = std::abs(glm::dot(linear.gradient, half_width)) +
                              std::abs(glm::dot(linear.gradient, half_height)) +
                              linear.error * largest;
        return {middle - around, middle + around};
    }
};

Directions directions_of(const Camera& camera, int left, int top, int right, int bottom) {
    const glm::dvec2 half = half_extent(camera);
    const auto farthest = [](int from, int to, int of) {
        return std::max(std::abs(2.0 * from / of - 1), std::abs(2.0 * to / of - 1));
    };
    return {line_of_sight(camera, (left + right) / 2.0, (top + bottom) / 2.0),
            half.x * (right - left - 1) / camera.width * camera.right,
            half.y * (bottom - top - 1) / camera.height * camera.up,
            1 + half.x * farthest(left, right, camera.width) +
                half.y * farthest(top, bottom, camera.height)};
}

// Each is so written that what is no number tells nothing.

bool may_meet(const SeenTriangle& triangle, const Directions& directions) {
    return std::ranges::none_of(triangle.edges,
                                [&](const Linear& edge) { return directions.of(edge).most < 0; });
}

bool covers(const SeenTriangle& triangle, const Directions& directions, const SeenRange& range) {
    if (!triangle.is_solid) return false;
    const Directions::Range inverse = directions.of(triangle.inverse);
    return inverse.most * range.near < 1 && inverse.least * range.far > 1 && inverse.least > 0 &&
           std::ranges::all_of(triangle.edges,
                               [&](const Linear& edge) { return directions.of(edge).least > 0; });
}

/// Whether a triangle's plane lies before another's along all rays.
bool stands_before(const SeenTriangle& one, const SeenTriangle& other,
                   const Directions& directions) {
    const Linear difference{one.inverse.gradient - other.inverse.gradient,
                            one.inverse.error + other.inverse.error};
    return directions.of(difference).least > 0;
}

} // namespace

/// What all squares are looked at with.
struct Areas::Seen {
    std::vector<SeenTriangle> triangles;
    std::span<const Camera> cameras;
    SeenRange range;
};

bool Areas::are_worth(const Tracer& tracer, std::size_t pixels) {
    return tracer.state().eye.w != 0 &&
           tracer.state().scene->triangles.size() * pixels_for_a_triangle <= pixels;
}

Areas::Areas(int width, int height)
    : width_(width), height_(height),
      blocks_in_row_(static_cast<std::size_t>((width + block_side - 1) / block_side)),
      asked_(blocks_in_row_ * static_cast<std::size_t>((height + block_side - 1) / block_side)),
      shows_(asked_.size(), untold),
      pixels_(std::make_unique_for_overwrite<std::uint32_t[]>(asked_.size() * block_pixels)) {}

template <class Visit>
void Areas::for_blocks(const Square& square, const Visit& visit) {
    for (int y = square.y; y < std::min(square.y + square.side, height_); y += block_side)
        for (int x = square.x; x < std::min(square.x + square.side, width_); x += block_side)
            visit(block(x, y));
}

/// Tells what the square shows, or what it is to be divided into; nothing where rays are quicker.
std::vector<Areas::Square> Areas::step(const Seen& seen, Square square) {
    std::size_t asked = 0;
    for_blocks(square, [&](std::size_t i) { asked += asked_[i]; });
    if (asked == 0) return {};
    const int right = std::min(square.x + square.side, width_);
    const int bottom = std::min(square.y + square.side, height_);
    const Directions directions =
        directions_of(seen.cameras[square.picture], square.x, square.y, right, bottom);
    const auto tell = [&](std::uint32_t triangle) {
        for_blocks(square, [&](std::size_t i) { shows_[i] = triangle; });
        return std::vector<Square>{};
    };
    const auto at = [&](std::uint32_t place) -> const SeenTriangle& {
        return seen.triangles[place];
    };
    std::erase_if(square.among,
                  [&](std::uint32_t place) { return !may_meet(at(place), directions); });
    if (square.among.empty()) return tell(no_triangle);

    std::optional<std::uint32_t> nearest; // of those that cover it, at its centre
    double inverse = 0;
    for (const std::uint32_t place : square.among) {
        const double own = glm::dot(at(place).inverse.gradient, directions.centre);
        if (!(own > inverse) || !covers(at(place), directions, seen.range)) continue;
        nearest = place;
        inverse = own;
    }
    if (nearest) {
        std::erase_if(square.among, [&](std::uint32_t place) {
            return place != *nearest && stands_before(at(*nearest), at(place), directions);
        });
        if (square.among.size() == 1) return tell(at(*nearest).triangle);
    }

    if (square.side == block_side) {
        if (square.among.size() * block_pixels_for_a_triangle <= asked) tell_pixels(seen, square);
        return {};
    }
    if (square.among.size() * pixels_for_a_triangle > asked) return {};
    const int half = square.side / 2;
    const auto part = [&](int x, int y) {
        return Square{square.picture, square.x + x, square.y + y, half, square.among};
    };
    return {part(0, 0), part(half, 0), part(0, half), part(half, half)};
}

// A pixel shows the nearest of the triangles that it surely shows, where none that it may show can
// be as near.
void Areas::tell_pixels(const Seen& seen, const Square& square) {
    struct Pixel {
        double least = 0; ///< of the nearest's inverse depth
        double most = 0;
        double rival = 0; ///< the largest that another's may have
        std::uint32_t nearest = no_triangle;
    };
    std::array<Pixel, block_pixels> pixels;
    const Directions directions = directions_of(seen.cameras[square.picture], square.x, square.y,
                                                square.x + block_side, square.y + block_side);
    constexpr std::array<double, block_side> columns{0, 1, 2, 3, 4, 5, 6, 7};
    constexpr double half_side = (block_side - 1) / 2.0;
    const glm::dvec3 across = directions.half_width / half_side;
    const glm::dvec3 down = directions.half_height / -half_side; // rows go down
    const glm::dvec3 first = directions.centre - half_side * (across + down);
    for (const std::uint32_t place : square.among) {
        const SeenTriangle& triangle = seen.triangles[place];
        const std::array<const Linear*, 4> linear{&triangle.edges[0], &triangle.edges[1],
                                                  &triangle.edges[2], &triangle.inverse};
        std::array<double, 4> at_first{}, step_across{}, step_down{}, error{};
        for (std::size_t k = 0; k < 4; ++k) {
            at_first[k] = glm::dot(linear[k]->gradient, first);
            step_across[k] = glm::dot(linear[k]->gradient, across);
            step_down[k] = glm::dot(linear[k]->gradient, down);
            error[k] = linear[k]->error * directions.largest;
        }
        for (std::size_t y = 0; y < block_side; ++y) {
            std::array<double, 4> row{};
            for (std::size_t k = 0; k < 4; ++k)
                row[k] = at_first[k] + static_cast<double>(y) * step_down[k];
            std::array<double, block_side> least{}, most{}, inverse{};
            for (std::size_t x = 0; x < block_side; ++x) { // so plain that it is done by vectors
                const double ab = row[0] + columns[x] * step_across[0];
                const double bc = row[1] + columns[x] * step_across[1];
                const double ca = row[2] + columns[x] * step_across[2];
                least[x] = std::min(std::min(ab - error[0], bc - error[1]), ca - error[2]);
                most[x] = std::min(std::min(ab + error[0], bc + error[1]), ca + error[2]);
                inverse[x] = row[3] + columns[x] * step_across[3];
            }
            for (std::size_t x = 0; x < block_side; ++x) {
                if (most[x] < 0) continue;
                Pixel& pixel = pixels[y * block_side + x];
                const double near = inverse[x] + error[3];
                const double far = inverse[x] - error[3];
                if (triangle.is_solid && least[x] > 0 && far > pixel.least) {
                    pixel.rival = std::max(pixel.rival, pixel.most);
                    pixel.least = far;
                    pixel.most = near;
                    pixel.nearest = triangle.triangle;
                } else if (!(near <= pixel.rival)) {
                    pixel.rival = near;
                }
            }
        }
    }
    const std::size_t own = block(square.x, square.y);
    shows_[own] = mixed;
    for (std::size_t i = 0; i < block_pixels; ++i) {
        const Pixel& pixel = pixels[i];
        const bool is_empty = pixel.nearest == no_triangle && pixel.rival == 0;
        const bool is_told =
            is_empty || (pixel.least > pixel.rival && pixel.most * seen.range.near < 1 &&
                         pixel.least * seen.range.far > 1);
        pixels_[own * block_pixels + i] = is_told ? pixel.nearest : untold;
    }
}

void Areas::divide(std::span<Areas> pictures, std::span<const Camera> cameras,
                   const Tracer& tracer) {
    const Tracer::State& state = tracer.state();
    const bool is_any_worth_it = std::ranges::any_of(pictures, [&](const Areas& picture) {
        return are_worth(
            tracer, std::accumulate(picture.asked_.begin(), picture.asked_.end(), std::size_t{0}));
    });
    if (!is_any_worth_it) return;
    Seen seen{{}, cameras, range_of(state.scene->camera)};
    for (std::uint32_t triangle = 0; triangle < state.scene->triangles.size(); ++triangle)
        if (const std::optional<SeenTriangle> one = seen_triangle(tracer, triangle))
            seen.triangles.push_back(*one);
    std::vector<std::uint32_t> all(seen.triangles.size());
    std::iota(all.begin(), all.end(), 0U);
    std::vector<Square> squares;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        Square whole{i, 0, 0, block_side, all};
        while (whole.side < std::max(pictures[i].width_, pictures[i].height_)) whole.side *= 2;
        squares.push_back(std::move(whole));
    }
    const auto divided = [&](Square square) {
        return pictures[square.picture].step(seen, std::move(square));
    };
    // A few squares for each thread, and then each by itself.
    constexpr std::size_t enough = 64;
    while (!squares.empty() && squares.size() < enough) {
        std::vector<Square> parts;
        for (Square& square : squares)
            std::ranges::move(divided(std::move(square)), std::back_inserter(parts));
        squares = std::move(parts);
    }
    parallel_for(static_cast<int>(squares.size()), state.threads, [&](int i, int) {
        std::vector<Square> left{std::move(squares[static_cast<std::size_t>(i)])};
        while (!left.empty()) {
            Square square = std::move(left.back());
            left.pop_back();
            std::ranges::move(divided(std::move(square)), std::back_inserter(left));
        }
    });
}

} // namespace shadowproof
