#include "scenes/surface/plane_equations.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace shadowproof {

namespace {

glm::dvec3 unit_or_zero(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0 ? v / length : glm::dvec3(0);
}

} // namespace

PlaneEquations plane_equations(const std::array<glm::dvec3, 3>& positions,
                               const std::array<glm::dvec2, 3>& at) {
    const glm::dvec3 edge = positions[1] - positions[0];
    const glm::dvec3 other = positions[2] - positions[0];
    const glm::dvec2 image = at[1] - at[0];
    const glm::dvec2 other_image = at[2] - at[0];
    PlaneEquations planes;
    planes.a = image.x * other_image.y - image.y * other_image.x;
    planes.b = image.y * other - edge * other_image.y;
    planes.c = edge * other_image.x - image.x * other;
    planes.d = -(planes.a * positions[0] + planes.b * at[0].x + planes.c * at[0].y);
    return planes;
}

TextureDirections directions_of(const PlaneEquations& planes) {
    if (planes.a == 0) return {};
    const double sign = planes.a < 0 ? 1 : -1;
    return {unit_or_zero(sign * planes.b), unit_or_zero(sign * planes.c)};
}

PlaneEquations mix(const PlaneEquations& from, const PlaneEquations& to, double share) {
    const double rest = 1 - share;
    return {rest * from.a + share * to.a, rest * from.b + share * to.b,
            rest * from.c + share * to.c, rest * from.d + share * to.d};
}

} // namespace shadowproof
