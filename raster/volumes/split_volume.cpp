#include "raster/volumes/split_volume.h"

#include <utility>

namespace shadowproof {

namespace {

/// Numbers of corners: those of the scene with `count` positions; those along directions from
/// `first` on.
struct Numbers {
    const SplitFarEnds& split;
    std::uint32_t count = 0;
    std::uint32_t first = 0;

    std::uint32_t extra(std::uint32_t direction) const { return first + direction; }
    std::uint32_t far_end(std::uint32_t position) const {
        const std::uint32_t* own = split.of(position);
        return own != nullptr ? extra(*own) : position + count;
    }
};

std::vector<glm::uvec3> split_caps(const Scene& casters, const ShadowVolume& volume,
                                   const Numbers& numbers) {
    std::vector<glm::uvec3> caps;
    for (std::size_t i = 0; i < volume.dark_cap.size(); ++i) {
        const std::uint32_t triangle = volume.facing[i];
        const glm::uvec3 corners = casters.triangles[triangle];
        const auto far_end = [&](std::uint32_t position) { return numbers.far_end(position); };
        const auto extra = [&](std::uint32_t direction) { return numbers.extra(direction); };
        if (numbers.split.behind(triangle) == nullptr) {
            caps.emplace_back(far_end(corners.z), far_end(corners.y), far_end(corners.x));
            continue;
        }
        for (const glm::uvec3& part : far_fan(numbers.split, triangle, corners, far_end, extra))
            caps.emplace_back(part.z, part.y, part.x);
    }
    return caps;
}

/// A side is (high, low, low's far end) and (high, low's far end, high's far end).
std::vector<glm::uvec3> split_sides(const std::vector<glm::uvec3>& sides, const Numbers& numbers) {
    std::vector<glm::uvec3> split;
    split.reserve(sides.size());
    for (std::size_t i = 0; i < sides.size(); i += 2) {
        const std::uint32_t high = sides[i].x;
        const std::uint32_t low = sides[i].y;
        const std::uint32_t far_low = numbers.far_end(low);
        const std::uint32_t far_high = numbers.far_end(high);
        if (const std::uint32_t* across = numbers.split.across(low, high)) {
            const std::uint32_t middle = numbers.extra(*across);
            split.emplace_back(middle, high, low);
            split.emplace_back(middle, low, far_low);
            split.emplace_back(middle, far_high, high);
        } else {
            split.emplace_back(high, low, far_low);
            split.emplace_back(high, far_low, far_high);
        }
    }
    return split;
}

} // namespace

Extruder with_split_far_ends(Extruder extruder, const Scene& casters, const SplitFarEnds& split,
                             std::uint32_t first) {
    if (split.empty()) return extruder;
    return [extruder = std::move(extruder), &casters, &split, first] {
        ShadowVolume volume = extruder();
        const Numbers numbers{split, static_cast<std::uint32_t>(casters.positions.size()), first};
        volume.dark_cap = split_caps(casters, volume, numbers);
        volume.sides = split_sides(volume.sides, numbers);
        volume.flipped_sides = split_sides(volume.flipped_sides, numbers);
        return volume;
    };
}

} // namespace shadowproof
