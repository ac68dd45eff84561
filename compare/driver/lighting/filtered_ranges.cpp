#include "compare/driver/lighting/filtered_ranges.h"

#include "compare/driver/lighting/powers_range.h"
#include "compare/driver/lighting/texel_ranges.h"
#include "scenes/driver.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <limits>

namespace shadowproof {

namespace {

constexpr double v = float_roundoff;

/// Roundings of a pixel's sides in texels: of a step times the texture's size, its square, the
/// squares' sum and its root, which halves those before it: 3 v. Of the quotient of both sides, or
/// of one and the lookups, v more, twice where a driver divides so.
constexpr double side_error = 3 * v;
constexpr double quotient_error = 2 * v;

/// A side of the pixel, in texels.
Interval side_of(const PlaceRange& step, const glm::ivec2& size) {
    const Interval square =
        square_of((1.0 * size.x) * step[0]) + square_of((1.0 * size.y) * step[1]);
    return {std::sqrt(square.low) * (1 - side_error), std::sqrt(square.high) * (1 + side_error)};
}

bool is_finite(const PlaceRange& step) {
    return std::ranges::all_of(
        step, [](const Interval& a) { return std::isfinite(a.low) && std::isfinite(a.high); });
}

/// log2 of texels, and 0 for up to one.
Interval level_of(const Interval& texels) {
    const auto log = [](double at) { return at > 1 ? std::log2(at) : 0; };
    const double low = log(texels.low * (1 - quotient_error));
    const double high = log(texels.high * (1 + quotient_error));
    return {std::max(low - log2_error(low), 0.0), high + (high > 0 ? log2_error(high) : 0)};
}

/// How many lookups a pixel whose sides are so much longer may get.
struct Probes {
    int least = 1;
    int most = 1;
};
Probes probes_of(const Interval& longer, const Interval& shorter, int anisotropy) {
    const auto kept = [&](double ratio) {
        return ratio < anisotropy ? std::max(1, static_cast<int>(std::ceil(ratio))) : anisotropy;
    };
    const auto over = [](double a, double b) {
        return b > 0 ? a / b : std::numeric_limits<double>::infinity();
    };
    return {kept(over(longer.low, shorter.high) * (1 - quotient_error)),
            kept(over(longer.high, shorter.low) * (1 + quotient_error))};
}

using TexelRange = RangeOf<glm::dvec4>;

/// A mixture, and the size of its largest texel, by which it may be rounded: a driver is free to
/// make a (1 - f) + b f of it, or a + f (b - a).
struct Mixed {
    TexelRange value{};
    glm::dvec4 size{0};
};

Mixed hull(const Mixed& a, const Mixed& b) {
    return {shadowproof::hull(a.value, b.value), glm::max(a.size, b.size)};
}

TexelRange mixed(const TexelRange& a, const TexelRange& b, double fraction) {
    TexelRange made;
    for (std::size_t k = 0; k < made.size(); ++k) made[k] = (1 - fraction) * a[k] + fraction * b[k];
    return made;
}
Mixed mixed(const Mixed& a, const Mixed& b, double fraction) {
    return {mixed(a.value, b.value, fraction), glm::max(a.size, b.size)};
}

/// Of anything within some bounds.
Mixed any_of(const TexelRange& bounds) {
    Mixed any{.value = bounds};
    for (int k = 0; k < 4; ++k) any.size[k] = size_of(bounds[static_cast<std::size_t>(k)]);
    return any;
}

/// Bilinear, in one level. Where the place is too uncertain, all of it.
Mixed in_level(const ExpectedMipmap& mipmap, std::size_t number, const TextureImage& map,
               const PlaceRange& at) {
    const Image<glm::vec4>& level = mipmap.levels[number];
    const TurningPlaces s = turning_places(map.wrap_s, level.width, at[0]);
    const TurningPlaces t = turning_places(map.wrap_t, level.height, at[1]);
    if (!s.all || !t.all) return any_of(mipmap.bounds[number]);
    const auto texel = [&](int x, int y) { return glm::dvec4(level.at(x, y)); };
    Mixed range{.value = mixed_range(s, t, texel, mipmap.bounds[number])};
    for (std::size_t i = 0; i < s.count; ++i)
        for (std::size_t j = 0; j < t.count; ++j)
            for (const int x : {s.taps[i].first, s.taps[i].second})
                for (const int y : {t.taps[j].first, t.taps[j].second})
                    range.size = glm::max(range.size, glm::abs(texel(x, y)));
    return range;
}

Mixed trilinear(const ExpectedMipmap& mipmap, const TextureImage& map, const PlaceRange& at,
                const Interval& level) {
    const auto top = static_cast<double>(mipmap.levels.size() - 1);
    const Interval kept = clamped(level, 0, top);
    Mixed range;
    bool any = false;
    for (double finer = std::floor(kept.low); finer <= kept.high; ++finer) {
        const auto in = [&](double number) {
            return in_level(mipmap, static_cast<std::size_t>(std::min(number, top)), map, at);
        };
        const Mixed here = in(finer);
        const Mixed next = in(finer + 1);
        for (const double end : {kept.low, kept.high}) {
            const Mixed one = mixed(here, next, std::clamp(end - finer, 0.0, 1.0));
            range = any ? hull(range, one) : one;
            any = true;
        }
    }
    return range;
}

/// Where a lookup is made: rounded are its part of the way (2 v), that times the way and its sum
/// with the place (v each).
PlaceRange probe_place(const PlaceRange& at, const FootprintRange& footprint, int probe) {
    if (footprint.probes == 1) return at;
    const double part = probe / (footprint.probes + 1.0) - 0.5;
    PlaceRange place;
    for (std::size_t k = 0; k < place.size(); ++k) {
        const Interval& along = footprint.along[k];
        const double size = std::max(
            {std::abs(along.low), std::abs(along.high), std::abs(at[k].low), std::abs(at[k].high)});
        place[k] = widened(at[k] + part * along, 4 * v * size);
    }
    return place;
}

/// Roundings of a mean of lookups: of each texel to a float, to the other side of a mean (2 v), of
/// three mixtures one of another, each of up to three roundings of sums and products that are no
/// larger than two texels (6 v each), of the lookups' sum, and of the quotient (2 v), as a share of
/// their largest texel.
double lookup_error(int probes) {
    return (2 + 3 * 6 + probes + 2) * v;
}

TexelRange rounded(const Mixed& mean, int probes) {
    TexelRange range = mean.value;
    for (int k = 0; k < 4; ++k) {
        Interval& component = range[static_cast<std::size_t>(k)];
        component = widened(component, lookup_error(probes) * mean.size[k] + float_underflow);
    }
    return range;
}

TexelRange mean_of_probes(const ExpectedMipmap& mipmap, const MipmapPlace& place,
                          const FootprintRange& footprint) {
    const double share = 1.0 / footprint.probes;
    Mixed mean;
    for (int probe = 1; probe <= footprint.probes; ++probe) {
        const Mixed one =
            trilinear(mipmap, place.map, probe_place(place.at, footprint, probe), footprint.level);
        for (std::size_t k = 0; k < mean.value.size(); ++k)
            mean.value[k] = mean.value[k] + share * one.value[k];
        mean.size = glm::max(mean.size, one.size);
    }
    return rounded(mean, footprint.probes);
}

} // namespace

std::vector<FootprintRange> footprint_ranges(const PlaceSteps& steps, const glm::ivec2& size,
                                             int anisotropy) {
    if (!is_finite(steps.across) || !is_finite(steps.down)) return {};
    const Interval across = side_of(steps.across, size);
    const Interval down = side_of(steps.down, size);
    if (anisotropy == 1)
        return {
            {level_of({std::max(across.low, down.low), std::max(across.high, down.high)}), 1, {}}};
    std::vector<FootprintRange> ranges;
    const auto add = [&](const Interval& side, const Interval& other, const PlaceRange& along) {
        if (side.high < other.low) return;
        const Interval longer{std::max(side.low, other.low), side.high};
        const Probes probes = probes_of(longer, other, anisotropy);
        for (int count = probes.least; count <= probes.most; ++count)
            ranges.push_back({level_of((1.0 / count) * longer), count, along});
    };
    add(across, down, steps.across);
    add(down, across, steps.down);
    return ranges;
}

TexelRange filtered_range(const ExpectedMipmap& mipmap, const MipmapPlace& place, int anisotropy) {
    const Image<glm::vec4>& finest = mipmap.levels[0];
    const std::vector<FootprintRange> footprints =
        footprint_ranges(place.steps, {finest.width, finest.height}, anisotropy);
    if (!footprints.empty())
        return mean_of_probes(mipmap, place, footprints[place.footprint % footprints.size()]);
    TexelRange range{};
    for (std::size_t level = 0; level < mipmap.bounds.size(); ++level) {
        const TexelRange one = rounded(any_of(mipmap.bounds[level]), anisotropy);
        range = level == 0 ? one : shadowproof::hull(range, one);
    }
    return range;
}

namespace {

/// Of vectors in a box.
Interval length_range(const Intervals& box) {
    const Interval square = square_of(box[0]) + square_of(box[1]) + square_of(box[2]);
    return {std::sqrt(square.low) * (1 - side_error), std::sqrt(square.high) * (1 + side_error)};
}

/// A mean of products less the product of means: two roundings, the first of the product.
Interval covariance(const Interval& product, const Interval& a, const Interval& b) {
    const Interval of_means = a * b;
    return widened(product + -1 * of_means, v * (size_of(product) + 2 * size_of(of_means)));
}

} // namespace

FilteredBumps filtered_bumps(const ExpectedPyramid& pyramid, const MipmapPlace& place,
                             const ColorModel& model) {
    const TexelRange mean = filtered_range(pyramid.texels, place, model.anisotropy);
    FilteredBumps bumps{.filter = model.filter};
    if (model.filter == BumpFilter::lean) {
        bumps.slope = {mean[0], mean[1]};
        bumps.normal = unit({{mean[0], mean[1], around(1)}});
        const Interval product = filtered_range(pyramid.cross, place, model.anisotropy)[0];
        bumps.spread = {covariance(mean[2], mean[0], mean[0]),
                        covariance(mean[3], mean[1], mean[1]),
                        covariance(product, mean[0], mean[1])};
        return bumps;
    }
    const Intervals direction{mean[0], mean[1], mean[2]};
    bumps.normal = unit({direction});
    if (model.filter == BumpFilter::dimmed) bumps.length = mean[3];
    if (model.filter == BumpFilter::toksvig) {
        const Interval length = length_range(direction);
        bumps.length = {std::min(length.low, 1.0), std::min(length.high, 1.0)};
    }
    return bumps;
}

DecalRange filtered_decal(const ExpectedMipmap& mipmap, const Material& material,
                          const MipmapPlace& place, int anisotropy) {
    const TexelRange texel = filtered_range(mipmap, place, anisotropy);
    // The factor's own rounding, and that of its product.
    const auto rounded = [](const Interval& a) {
        return widened(a, 2 * (v * std::abs(a.high) + float_underflow));
    };
    DecalRange decal;
    if (material.gloss_in_alpha) decal.gloss = rounded(texel[3]);
    for (std::size_t k = 0; k < 3; ++k)
        decal.color[k] = rounded(material.color[static_cast<int>(k)] * texel[k]);
    return decal;
}

} // namespace shadowproof
