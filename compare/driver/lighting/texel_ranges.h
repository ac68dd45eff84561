// Bounds of a texture over a range of places, filtered bilinearly as texture.h and cube_map.h
// define it. Between four texels' centres each component is linear along either axis, so it is
// extreme at corners: those of the range, and the texels in it. The bounds are conservative.
#pragma once

#include "compare/driver/interval.h"
#include "scenes/cube_map.h"
#include "scenes/texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace shadowproof {

/// The places along one axis at which the filtered value may be extreme. At most `most` are kept;
/// if there are more, `all` is false.
struct TurningPlaces {
    static constexpr std::size_t most = 32;
    std::array<Taps, most> taps{};
    std::size_t count = 0;
    bool all = true;
};

inline TurningPlaces turning_places(Wrap wrap, int texels, const Interval& at) {
    TurningPlaces places;
    places.taps[places.count++] = taps_at(wrap, texels, at.low);
    if (!(at.high > at.low)) return places;
    places.taps[places.count++] = taps_at(wrap, texels, at.high);
    const double first = std::ceil(texels * at.low - 0.5);
    const double last = std::floor(texels * at.high - 0.5);
    places.all = last - first < static_cast<double>(TurningPlaces::most - places.count);
    if (!places.all) return places;
    for (double texel = first; texel <= last; ++texel)
        places.taps[places.count++] = taps_at(wrap, texels, (texel + 0.5) / texels);
    return places;
}

/// Bounds of the bilinear mixture of the texels `value_of(x, y)`. `whole`: bounds of any texel.
template <class ValueOf, class Range>
Range mixed_range(const TurningPlaces& s, const TurningPlaces& t, const ValueOf& value_of,
                  const Range& whole) {
    if (!s.all || !t.all) return whole;
    const auto mixed = [&](const Taps& u, const Taps& v) {
        const auto along = [&](int row) {
            const auto a = value_of(u.first, row);
            return a + u.fraction * (value_of(u.second, row) - a);
        };
        const auto upper = along(v.first);
        return upper + v.fraction * (along(v.second) - upper);
    };
    Range range = range_of(mixed(s.taps[0], t.taps[0]));
    for (std::size_t i = 0; i < s.count; ++i)
        for (std::size_t j = 0; j < t.count; ++j)
            if (i + j > 0) range = hull(range, range_of(mixed(s.taps[i], t.taps[j])));
    return range;
}

/// Calls visit(face, s, t) for each face of a cube map at which any of some vectors may point, with
/// the range of places there, within [-1, 1]. If the vectors may be zero, these are whole faces.
template <class Visit>
void visit_faces(const Intervals& vectors, const Visit& visit) {
    const auto least_size = [&](std::size_t k) {
        return std::max({vectors[k].low, -vectors[k].high, 0.0});
    };
    for (std::size_t face = 0; face < face_axes.size(); ++face) {
        const std::size_t axis = face / 2;
        const double sign = face % 2 == 0 ? 1 : -1;
        const Interval major = sign * vectors[axis];
        // On this face its component is the largest.
        const double others = std::max(least_size((axis + 1) % 3), least_size((axis + 2) % 3));
        if (major.high < others || major.high <= 0) continue;
        const double least = std::max({major.low, others, 0.0});
        const auto place = [&](const glm::dvec3& along) {
            if (!(least > 0)) return Interval{-1, 1};
            Interval across{0, 0};
            for (int k = 0; k < 3; ++k)
                if (along[k] != 0) across = along[k] * vectors[static_cast<std::size_t>(k)];
            return clamped(across * Interval{1 / major.high, 1 / least}, -1, 1);
        };
        visit(face, place(face_axes[face].s), place(face_axes[face].t));
    }
}

/// Bounds of a cube map's lookup along any of some vectors. `whole`: bounds of any texel.
template <class Texel>
Intervals cube_range(const CubeFaces<Texel>& faces, const Intervals& vectors,
                     const Intervals& whole) {
    Intervals range;
    bool any = false;
    visit_faces(vectors, [&](std::size_t face, const Interval& s, const Interval& t) {
        const Image<Texel>& texels = faces[face];
        const auto places = [&](const Interval& along) {
            return turning_places(Wrap::clamp_to_edge, texels.width, 0.5 * (along + around(1)));
        };
        const Intervals here = mixed_range(
            places(s), places(t), [&](int x, int y) { return glm::dvec3(texels.at(x, y)); }, whole);
        range = any ? hull(range, here) : here;
        any = true;
    });
    return range;
}

} // namespace shadowproof
