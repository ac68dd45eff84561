// The view depths that the rasterizer may give to surfaces and volume faces at one pixel.
#pragma once

#include "compare/driver/neighbourhood.h"
#include "compare/driver/setup_error.h"
#include "reference/predict/ledger.h"
#include "scenes/frame.h"
#include "scenes/scene.h"

#include <algorithm>
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

namespace shadowproof {

/// Depth at which a line of sight meets a triangle's plane; infinite where that is behind the eye.
double plane_depth(const Scene& scene, std::uint32_t triangle, const glm::dvec3& line);

/// Depth at which another line of sight than the crossing's own, `line`, meets its plane; likewise.
double face_depth(const Camera& camera, const Crossing& crossing, const glm::dvec3& line,
                  const glm::dvec3& other);

struct DepthRange {
    double nominal = 0; ///< on the sample's own ray
    double lower = 0;
    double upper = 0;

    void include(double depth, double error) {
        lower = std::min(lower, depth - error);
        upper = std::max(upper, depth + error);
    }
};

/// Volumes as drawn: of `casters`, with far ends at infinity where `far_ends` is null.
struct DrawnVolumes {
    const Scene& casters;
    const std::vector<glm::vec3>* far_ends = nullptr;
};

class FaceDepths {
public:
    /// Keeps references to all. `far`: the far plane of techniques that have a finite one.
    FaceDepths(const Scene& scene, const DrawnVolumes& volumes, const Frame& frame, double far,
               const Neighbourhood& around)
        : scene_(scene), volumes_(volumes), frame_(frame), far_(far), around_(around) {}

    /// What the depth buffer was cleared to.
    DepthRange background() const;
    /// A triangle's plane over the neighbourhood; the nominal depth is left at zero.
    DepthRange surface(std::uint32_t triangle) const;
    /// A volume face's plane over the neighbourhood, met on the line of sight `line`.
    DepthRange face(const Crossing& crossing, const glm::dvec3& line) const;

    /// How far off the planes of both are set up, in view depth, where a ray meets them.
    double setup_error_at(std::uint32_t triangle, double depth) const {
        return plane_error(triangle) * depths_of_key(depth);
    }
    double setup_error_at(const Crossing& crossing) const;

    /// The far plane's depth where it clips, else infinity.
    double clip_far() const;
    /// A clipping plane's depth, moved by -1, 0 or 1 times that depth's error: it is rounded like
    /// any depth.
    double clip_depth(double depth, int move) const;

    /// The pixel, as bounds of its faces' errors take it.
    CoveredPixel covered_pixel() const;

private:
    const Scene& scene_;
    DrawnVolumes volumes_;
    const Frame& frame_;
    double far_;
    const Neighbourhood& around_;
    // Computed once at this pixel for each face, by its part and its edge (as Crossing has it) or
    // triangle, and for each triangle of the scene.
    mutable std::map<std::pair<Crossing::Part, std::uint32_t>, double> setup_of_face_;
    mutable std::unordered_map<std::uint32_t, double> setup_of_triangle_;

    /// The change of view depth with the key of picture points (clipped_polygon.h).
    double depths_of_key(double depth) const;
    double plane_error(const Crossing& face) const;
    double plane_error(std::uint32_t triangle) const;
};

} // namespace shadowproof
