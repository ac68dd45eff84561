#include "compare/maps/lookup.h"

#include "compare/driver/plane_at_pixel.h"
#include "scenes/cube_map.h"
#include "scenes/driver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

namespace shadowproof {

namespace {

constexpr double v = float_roundoff;

/// The comparison of one value with many texels, without any rounding.
class Comparator {
public:
    Comparator(const MapModel& model, double value);
    bool is_shadowed(double stored) const;

private:
    const MapModel& model_;
    double value_;
    double limit_ = 0; ///< of what is stored; not used with distances
};

double value_of(const MapModel& model, const glm::dvec3& from_light, double depth) {
    return model.value == MapValue::depth ? depth : glm::length(from_light);
}

int step_of_stored(double stored) {
    return static_cast<int>(std::lround(stored * (ramp_steps - 1)));
}

/// Quicker than std::floor; for what fits into an int.
int floor_of(double value) {
    const int towards_zero = static_cast<int>(value);
    return towards_zero - (value < towards_zero ? 1 : 0);
}

int clamped(const MapModel& model, double place) {
    return floor_of(std::clamp(place, 0.0, model.size - 1.0));
}

/// The first texel of what is asked at a place in the map: of a block, as near as no block lies
/// farther beside the map, or the one there.
glm::ivec2 first_of(const MapModel& model, const glm::dvec2& place) {
    if (model.filter == 0) return {clamped(model, place.x), clamped(model, place.y)};
    const auto first = [&](double at) {
        return floor_of(
            std::clamp(at - 0.5 * (model.filter - 1), -1.0 * model.filter, 1.0 * model.size));
    };
    return {first(place.x), first(place.y)};
}

/// Beside a cube's face: the texel of the adjacent face that lies as far beyond the edge which they
/// share. Beyond two edges there is none; there the row is moved to the face's outermost.
///
/// In units of half a texel, the face's plane is `size` away from the light along `major`, and
/// texels' centres lie at odd or at even numbers between -size and size. What lies beyond an edge
/// is folded towards the light, around the edge.
Texel across_edges(int size, Texel texel) {
    const FaceAxes& axes = face_axes[texel.face];
    int along_s = 2 * texel.x + 1 - size;
    int along_t = size - 1 - 2 * texel.y; // pictures begin at the top
    const auto is_beyond = [&](int along) { return std::abs(along) > size; };
    if (is_beyond(along_s)) along_t = std::clamp(along_t, 1 - size, size - 1);
    if (!is_beyond(along_s) && !is_beyond(along_t)) return texel;
    const int beyond = std::max(std::abs(along_s), std::abs(along_t)) - size;
    const double away = std::max(size - beyond, 1 - size);
    const double s = std::clamp(along_s, -size, size);
    const double t = std::clamp(along_t, -size, size);
    const glm::dvec3 place = away * axes.major + s * axes.s + t * axes.t;
    texel.face = static_cast<std::uint32_t>(face_of(place));
    const FaceAxes& adjacent = face_axes[texel.face];
    texel.x = (static_cast<int>(glm::dot(place, adjacent.s)) + size - 1) / 2;
    texel.y = (size - 1 - static_cast<int>(glm::dot(place, adjacent.t))) / 2;
    return texel;
}

/// A vector's error: of the matrix that rotates it into a square's axes, an entry, a product and
/// the sums; a cube asks with the vector itself.
glm::dvec3 rotated_error(const LightView& light, const UncertainPoint& point) {
    if (light.model().shape == MapModel::Shape::cube) return point.error;
    const glm::dvec3 size = glm::abs(point.from_light) + point.error;
    return point.error + 4 * v * (size.x + size.y + size.z);
}

/// The eight corners of the box in which the vector lies.
std::array<glm::dvec3, 8> corners_of(const glm::dvec3& vector, const glm::dvec3& error) {
    std::array<glm::dvec3, 8> corners{};
    for (unsigned i = 0; i < 8; ++i)
        corners[i] = vector + error * glm::dvec3((i & 1U) != 0 ? 1 : -1, (i & 2U) != 0 ? 1 : -1,
                                                 (i & 4U) != 0 ? 1 : -1);
    return corners;
}

/// Least and largest value in the box: a distance is least at its point nearest to the light.
std::pair<double, double> range_of_value(const MapModel& model, const Camera& camera,
                                         const UncertainPoint& point) {
    if (model.value == MapValue::depth) {
        const double depth = glm::dot(point.from_light, camera.forward);
        const double error = glm::dot(point.error, glm::abs(camera.forward));
        return {depth - error, depth + error};
    }
    const glm::dvec3 away = glm::abs(point.from_light);
    return {glm::length(glm::max(away - point.error, glm::dvec3(0))),
            glm::length(away + point.error)};
}

/// Whether a vector in the box may be asked of the face: no other axis is certainly larger.
bool may_pierce(const LightView& light, std::size_t face, const UncertainPoint& point) {
    if (light.model().shape == MapModel::Shape::sun) return true;
    const glm::dvec3& axis = light.camera(face).forward;
    const double most = glm::dot(point.from_light, axis) + glm::dot(point.error, glm::abs(axis));
    if (!(most > 0)) return false;
    if (light.model().shape == MapModel::Shape::spot) return true;
    const glm::dvec3 least = glm::max(glm::abs(point.from_light) - point.error, glm::dvec3(0));
    return most >= std::max({least.x, least.y, least.z});
}

} // namespace

Lookup lookup(const LightView& light, const glm::dvec3& from_light) {
    const MapModel& model = light.model();
    const std::size_t face = model.shape == MapModel::Shape::cube ? face_of(from_light) : 0;
    const Camera& camera = light.camera(face);
    Lookup found;
    found.depth = glm::dot(from_light, camera.forward);
    found.value = value_of(model, from_light, found.depth);
    found.in_map = model.shape == MapModel::Shape::sun || found.depth > 0;
    if (!found.in_map) return found;
    const glm::dvec2 place = place_in_map(model, camera, from_light);
    found.texel = {static_cast<std::uint32_t>(face), clamped(model, place.x),
                   clamped(model, place.y)};
    found.first = first_of(model, place);
    return found;
}

Texel texel_of_block(const MapModel& model, const Texel& texel) {
    if (model.shape == MapModel::Shape::cube && model.edges == MapEdges::seamless)
        return across_edges(model.size, texel);
    return {texel.face, std::clamp(texel.x, 0, model.size - 1),
            std::clamp(texel.y, 0, model.size - 1)};
}

bool crosses_edge(const MapModel& model, const Lookup& lookup) {
    return model.shape == MapModel::Shape::cube && model.filter > 0 && !lies_within(model, lookup);
}

Texel own_texel(const MapModel& model, const Lookup& asked, const Texel& place) {
    if (model.filter == 0) return asked.texel;
    const bool is_elsewhere = place.face != asked.texel.face;
    const auto nearest = [&](int at, int first) {
        const int wanted = is_elsewhere ? first : at;
        return std::clamp(std::clamp(wanted, first, first + model.filter - 1), 0, model.size - 1);
    };
    return {asked.texel.face, nearest(place.x, asked.first.x), nearest(place.y, asked.first.y)};
}

// Seen from a face, or in parallel, a box's picture is within the rectangle of its corners' as long
// as all lie before the camera. The division, the halving, the sum and the product with the size
// round by v of at most the map's size each: 4 v, of which the quotient's counts twice; and where a
// block is asked, the difference to its first texel.
std::optional<PossibleLookup>
find_possible_lookup(const LightView& light, const UncertainPoint& point,
                     const std::function<bool(const PossibleLookup&)>& holds) {
    const MapModel& model = light.model();
    const UncertainPoint asked{point.from_light, rotated_error(light, point)};
    const std::array<glm::dvec3, 8> corners = corners_of(asked.from_light, asked.error);
    for (std::size_t face = 0; face < model.faces(); ++face) {
        if (!may_pierce(light, face, asked)) continue;
        const Camera& camera = light.camera(face);
        glm::dvec2 low(model.size, model.size);
        glm::dvec2 high(0, 0);
        for (const glm::dvec3& corner : corners) {
            if (model.shape != MapModel::Shape::sun && !(glm::dot(corner, camera.forward) > 0)) {
                // The light itself lies in the box.
                low = {0, 0};
                high = {model.size, model.size};
                break;
            }
            const glm::dvec2 place = place_in_map(model, camera, corner);
            low = glm::min(low, place);
            high = glm::max(high, place);
        }
        const auto [least, most] = range_of_value(model, camera, asked);
        const double rounding = (model.filter > 0 ? 6 : 5) * v * model.size;
        const glm::ivec2 from = first_of(model, low - rounding);
        const glm::ivec2 to = first_of(model, high + rounding);
        for (int y = from.y; y <= to.y; ++y)
            for (int x = from.x; x <= to.x; ++x) {
                Lookup lookup;
                lookup.texel.face = static_cast<std::uint32_t>(face);
                if (model.filter > 0)
                    lookup.first = {x, y};
                else
                    lookup.texel = {static_cast<std::uint32_t>(face), x, y};
                const PossibleLookup found{lookup, least, most};
                if (holds(found)) return found;
            }
    }
    return std::nullopt;
}

// Distances: a product, a sum, and a length of three products, two sums and a root. Depths: the
// difference, and the projection's quotient, difference, product and constant, the last of which
// rounds twice; in parallel, and on a ramp, two differences and a quotient, each by v of a number
// that may be above 1; on a ramp also the sampler's product with the number of its texels.
Answers compare(const MapModel& model, double stored, double low, double high) {
    const double b = model.bias;
    if (model.value == MapValue::distance) {
        const double map = stored * model.far;
        const double error = 2 * v * (map + std::abs(b)) + 4 * v * high;
        return {map + b < high + error, map + b >= low - error};
    }
    const double shift = v * (std::max(std::abs(low), std::abs(high)) + std::abs(b));
    const double least = low - b - shift;
    const double most = high - b + shift;
    if (model.is_ramp()) {
        const auto step = [&](double depth, double sign) {
            const double place = place_on_ramp(model, depth);
            return ramp_step(place + sign * 4 * v * std::abs(place));
        };
        const int read = step_of_stored(stored);
        return {read < step(most, +1), read >= step(least, -1)};
    }
    if (model.shape == MapModel::Shape::sun) {
        const auto error = [](double window) { return 3 * v * std::abs(window); };
        const double from = map_window_depth(model, least);
        const double to = map_window_depth(model, most);
        return {stored < to + error(to), stored >= from - error(from)};
    }
    const bool may_be_beyond = most > model.near;
    const bool may_be_before = least <= model.near;
    return {may_be_beyond && stored < map_window_depth(model, most) + 5 * v,
            may_be_before || stored >= map_window_depth(model, least) - 5 * v};
}

Comparator::Comparator(const MapModel& model, double value) : model_(model), value_(value) {
    if (model.value == MapValue::distance) return;
    const double nearer = value - model.bias;
    if (model.is_ramp())
        limit_ = ramp_step(place_on_ramp(model, nearer));
    else if (model.shape == MapModel::Shape::sun || nearer > model.near)
        limit_ = map_window_depth(model, nearer);
    else
        limit_ = -std::numeric_limits<double>::infinity();
}

bool Comparator::is_shadowed(double stored) const {
    if (model_.value == MapValue::distance) return stored * model_.far + model_.bias < value_;
    return (model_.is_ramp() ? step_of_stored(stored) : stored) < limit_;
}

bool is_shadowed(const MapModel& model, double stored, double value) {
    return Comparator(model, value).is_shadowed(stored);
}

namespace {

/// The mean of what the texels hold, as they were read back.
double mean_stored(const LightView& light, const MapModel& model, const Lookup& lookup) {
    double sum = 0;
    visit_asked(model, lookup, [&](const Texel& texel) { sum += light.stored(texel); });
    return sum / model.asked();
}

} // namespace

int lit_comparisons(const LightView& light, const MapModel& model, const Lookup& lookup) {
    if (model.average == MapAverage::values)
        return is_shadowed(model, mean_stored(light, model, lookup), lookup.value) ? 0
                                                                                   : model.asked();
    const Comparator comparator(model, lookup.value);
    int lit = 0;
    if (model.filter > 0 && lies_within(model, lookup)) {
        for (int y = 0; y < model.filter; ++y)
            for (const float stored : light.stored_row(
                     {lookup.texel.face, lookup.first.x, lookup.first.y + y}, model.filter))
                lit += comparator.is_shadowed(stored) ? 0 : 1;
        return lit;
    }
    visit_asked(model, lookup, [&](const Texel& texel) {
        lit += comparator.is_shadowed(light.stored(texel)) ? 0 : 1;
    });
    return lit;
}

// A mean of n values: n - 1 sums and a quotient.
LitRange lit_range(const LightView& light, const PossibleLookup& possible) {
    const MapModel& model = light.model();
    if (model.average == MapAverage::values) {
        const double mean = mean_stored(light, model, possible.lookup);
        const double error = model.asked() * v * mean;
        const Answers less = compare(model, mean - error, possible.low, possible.high);
        const Answers more = compare(model, mean + error, possible.low, possible.high);
        return {less.shadowed ? 0 : model.asked(), more.lit ? model.asked() : 0};
    }
    LitRange range;
    visit_asked(model, possible.lookup, [&](const Texel& texel) {
        const Answers answers = compare(model, light.stored(texel), possible.low, possible.high);
        range.least += answers.shadowed ? 0 : 1;
        range.most += answers.lit ? 1 : 0;
    });
    return range;
}

} // namespace shadowproof
