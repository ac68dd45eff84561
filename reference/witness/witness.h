// The witness: visibility and shadow depth by brute force over rationals, triangle by triangle. It
// shares no code with the rest of reference/ but the scene's own structs, and uses other formulas:
// hit points, not edge planes. Triangles far from a line are skipped, by bounding spheres with a
// margin a million times the error of doubles. Light-facing triangles are counted whole, whatever
// their masks leave out.
#pragma once

#include "scenes/frame.h"
#include "scenes/scene.h"

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace shadowproof::witness {

using Point = std::array<mpq_class, 3>;

struct Plane {
    Point a, b, c, normal;
    bool has_area = false;
    bool seen_from_behind = false;
    bool casts = true;
    bool receives = true;
    const AlphaMask* mask = nullptr;                   ///< of the scene
    std::array<std::array<mpq_class, 2>, 3> mask_at{}; ///< coordinates in it, by corner
    glm::dvec3 center{0, 0, 0};                        ///< of an approximate bounding sphere
    double radius = 0;
};

struct Answer {
    Visibility visibility = Visibility::background;
    std::uint32_t triangle = no_triangle;
    Point hit;
};

class Witness {
public:
    explicit Witness(const Scene& scene);

    /// What a line of sight (camera.h) meets.
    Answer look(const glm::dvec3& line) const;

    /// Light-facing triangles strictly between q and the light; ties broken by really moving the
    /// line's end by (e, e^2, e^3) with e = 2^-400. `skip` does not count.
    int shadow_depth(const Point& q, std::uint32_t skip) const;
    /// The same for the point at infinity in a line's direction from a point light; for one 2^2000
    /// away along the line where the light is directional: along a line whose direction is really
    /// moved, where all lines have it.
    int shadow_depth_at_infinity(const glm::dvec3& line) const;
    /// The same at the eye; where that is a direction, opposite to infinity.
    int shadow_depth_at_eye() const;

    Point on_ray(const glm::dvec3& line, double depth) const;
    int side_of_eye(std::uint32_t triangle) const;   ///< 1: the front is seen
    int side_of_light(std::uint32_t triangle) const; ///< 1: the front is lit

    /// The side of the spot light's outer cone on which p lies, by cosines: -1 outside, 0 on the
    /// cone, 1 inside. 1 where the light is no spot.
    int side_of_cone(const Point& p) const;

private:
    Camera camera_;
    Point eye_;   ///< its place, or the direction to it
    Point light_; ///< position, or direction to it
    bool directional_ = false;
    std::optional<Point> spot_axis_;
    mpq_class spot_cosine_;
    mpq_class near_;
    std::optional<mpq_class> far_;
    std::vector<Plane> planes_;

    Point to_light(const Point& p) const;
    bool lies_between(const mpq_class& s) const;
    glm::dvec3 light_rounded_{0, 0, 0};

    bool occluded(const Point& hit, std::uint32_t own) const;
};

} // namespace shadowproof::witness
