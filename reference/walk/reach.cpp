#include "reference/walk/reach.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace shadowproof {

namespace {

double reach_of(const Box& box, const glm::dvec3& origin) {
    double reach = 0;
    for (int axis = 0; axis < 3; ++axis)
        reach = std::max({reach, std::abs(double{box.lower[axis]} - origin[axis]),
                          std::abs(double{box.upper[axis]} - origin[axis])});
    return reach;
}

glm::dvec3 middle_of(const Box& box) {
    return 0.5 * (glm::dvec3(box.lower) + glm::dvec3(box.upper));
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The median of the boxes' middles, by component.
glm::dvec3 median_middle(const Clusters& clusters) {
    std::array<std::vector<double>, 3> middles;
    for (const Box& box : clusters.boxes) {
        const glm::dvec3 middle = middle_of(box);
        for (std::size_t i = 0; i < 3; ++i) middles[i].push_back(middle[static_cast<int>(i)]);
    }
    return {median(middles[0]), median(middles[1]), median(middles[2])};
}

/// What lies further out than the median cluster by this factor is outlying: of what floats can
/// tell apart when all is scaled to 1, little would be left for the others.
constexpr double outlying = 0x1p20;

} // namespace

double reach_of_most(const Clusters& clusters, const glm::dvec3& origin) {
    const double whole = reach_of(clusters.box, origin);
    std::vector<double> reaches;
    reaches.reserve(clusters.boxes.size());
    for (const Box& box : clusters.boxes) reaches.push_back(reach_of(box, origin));
    const double limit = median(reaches) * outlying;
    if (!(limit > 0) || whole <= limit) return whole;
    double reach = 0;
    for (const double each : reaches)
        if (each <= limit) reach = std::max(reach, each);
    return reach;
}

glm::dvec3 center_of_most(const Clusters& clusters) {
    const glm::dvec3 among_most = median_middle(clusters);
    return reach_of_most(clusters, among_most) < reach_of(clusters.box, among_most)
               ? among_most
               : middle_of(clusters.box);
}

} // namespace shadowproof
