#include "scenes/mesh/smooth_normals.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof {

namespace {

/// The angle between two vectors of any length, by its tangent, which is accurate for small angles
/// too.
double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

} // namespace

std::vector<glm::dvec3> smooth_normals(const std::vector<glm::dvec3>& positions,
                                       const std::vector<glm::uvec3>& triangles) {
    std::vector<glm::dvec3> normals(positions.size(), glm::dvec3(0));
    for (const glm::uvec3& triangle : triangles) {
        const glm::dvec3 across = glm::cross(positions[triangle.y] - positions[triangle.x],
                                             positions[triangle.z] - positions[triangle.x]);
        const double area = glm::length(across);
        if (!(area > 0)) continue;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3& here = positions[triangle[k]];
            normals[triangle[k]] += across / area *
                                    angle_between(positions[triangle[(k + 1) % 3]] - here,
                                                  positions[triangle[(k + 2) % 3]] - here);
        }
    }
    for (glm::dvec3& normal : normals) {
        const double length = glm::length(normal);
        normal = length > 0 ? normal / length : glm::dvec3(0, 0, 1);
    }
    return normals;
}

} // namespace shadowproof
