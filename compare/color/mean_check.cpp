#include "compare/color/mean_check.h"

#include "compare/driver/lighting/lighting_arithmetic.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>

namespace shadowproof {

namespace {

constexpr double degrees_of_bin = 10;

struct Squares {
    double sum = 0;
    std::uint64_t pixels = 0;

    void add(double squares) {
        sum += squares;
        ++pixels;
    }
    double rmse() const {
        return pixels > 0 ? std::sqrt(sum / (3 * static_cast<double>(pixels))) : 0;
    }
};

using Bins = std::map<int, Squares>; ///< by number, in its order

template <class Start>
std::vector<ErrorBin> bins_of(const Bins& bins, const Start& start) {
    std::vector<ErrorBin> made;
    for (const auto& [number, squares] : bins)
        made.push_back({start(number), start(number + 1), squares.pixels, squares.rmse()});
    return made;
}

} // namespace

MeanCheck check_means(const PixelMeans& means, const Frame& frame,
                      const Image<ColorVerdict>& verdicts) {
    MeanCheck check{.noise = means.noise};
    for (const glm::u8vec2& rays : means.rays.pixels)
        check.most_rays = std::max(check.most_rays, int{rays.x} * int{rays.y});
    Squares all;
    Squares alike;
    Bins by_texels;
    Bins by_angle;
    for (std::size_t i = 0; i < verdicts.pixels.size(); ++i) {
        if (verdicts.pixels[i] == ColorVerdict::as_shown) continue;
        const glm::dvec3 right = showable(frame.color_model, means.color.pixels[i]);
        const glm::dvec3 off = 255.0 * (glm::dvec3(frame.color.pixels[i]) - right);
        const double squares = glm::dot(off, off);
        all.add(squares);
        if (means.share_alike.pixels[i] < 1) continue;
        alike.add(squares);
        const double texels = means.texels.pixels[i];
        if (!(texels > 0)) continue;
        by_texels[static_cast<int>(std::floor(std::log2(texels)))].add(squares);
        const double cosine = std::min(1.0, double{means.cosine.pixels[i]});
        const double angle = std::acos(cosine) * 180 / std::numbers::pi;
        by_angle[static_cast<int>(angle / degrees_of_bin)].add(squares);
    }
    check.rmse = all.rmse();
    check.alike = alike.pixels;
    check.alike_rmse = alike.rmse();
    check.by_texels = bins_of(by_texels, [](int number) { return std::exp2(number); });
    check.by_angle = bins_of(by_angle, [](int number) { return number * degrees_of_bin; });
    return check;
}

} // namespace shadowproof
