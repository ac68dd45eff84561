// The planes of visible triangles, by which depths along eye rays are computed, with bounds of
// their errors.
#pragma once

#include "reference/walk/box_tree.h"
#include "scenes/scene.h"

#include <cstdint>
#include <vector>

namespace shadowproof {

/// A plane of each lane, and what is computed from it.
struct PlaneLanes {
    Vectors normal;
    alignas(64) Lanes<double> normal_error{};    ///< per component
    alignas(64) Lanes<double> normal_size{};     ///< the largest component
    alignas(64) Lanes<double> numerator{};       ///< (a - E) . normal, E where the line starts
    alignas(64) Lanes<double> numerator_error{}; ///< relative
    alignas(64) Lanes<double> depth{};
    alignas(64) Lanes<double> depth_error{};
};

/// Keeps the planes of the triangles that neighbouring rays see.
class SeenPlanes {
public:
    explicit SeenPlanes(const Scene& scene);

    /// Sets the view depth at which each lane's line of sight meets the plane of its triangle, and
    /// a bound of its error, infinite where nothing is known. Other lanes are left as they are.
    void measure(const Vectors& lines, std::uint32_t lanes, const Lanes<std::uint32_t>& triangles,
                 Lanes<double>& depth, Lanes<double>& depth_error);

private:
    struct Plane {
        std::uint32_t triangle = no_triangle;
        glm::dvec3 normal{0, 0, 0};
        double normal_error = 0;
        double normal_size = 0;
        glm::dvec3 corner{0, 0, 0};
        double edges = 0; ///< PlaneEdges::product
        double numerator = 0;
        double numerator_error = 0;

        void start_from(const glm::dvec3& start); ///< sets the numerator
    };
    const Scene* scene_;
    Vectors forward_; ///< where lines of sight are parallel: the direction of all
    std::vector<Plane> planes_;
    PlaneLanes lanes_;

    Plane& plane_of(std::uint32_t triangle);
};

} // namespace shadowproof
