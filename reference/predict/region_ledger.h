// The ledgers of all eye rays in a small region of the picture: only the silhouettes of the shadow
// volumes are tested, of which few reach one region. A hundred times faster than ray by ray.
#pragma once

#include "reference/predict/ledger.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace shadowproof {

/// The silhouette edges of a scene as seen from its light: computed once, for all regions.
class Silhouette {
public:
    explicit Silhouette(const Tracer& tracer);

    /// A side of the shadow volumes, over the edge from vertex p to q, p before q.
    struct Side {
        std::uint32_t p = 0; ///< indices into vertices
        std::uint32_t q = 0;
        int surplus = 0; ///< how many sides lie there; negative where they run from p to q
        std::uint32_t triangle = no_triangle; ///< the first that has this edge
        Crossing::Part part = Crossing::Part::side_0;
        std::uint32_t number = 0;  ///< of this side, in the order of all
        bool flipped = false;      ///< as Crossing::flipped
        glm::dvec3 plane{0, 0, 0}; ///< as side_plane gives it
        double eye = 0;            ///< the eye's side of that plane
        glm::dvec3 edge{0, 0, 0};  ///< normal of the plane through the eye and the edge
    };
    struct Vertex {
        glm::dvec3 position{0, 0, 0};
        glm::dvec3 plane{0, 0, 0}; ///< normal of the plane through it, eye and light
    };

    const std::vector<Vertex>& vertices() const { return vertices_; }
    const std::vector<Side>& sides() const { return sides_; }

private:
    std::vector<Vertex> vertices_;
    std::vector<Side> sides_;
};

/// Pixels along the side of the regions into which a picture is divided. As measured, 8 and 32 take
/// a third longer.
inline constexpr int region_side = 16;

class RegionLedger {
public:
    /// `corners`: directions of four rays of the picture whose rectangle contains all rays to be
    /// queried, as from corner_lines: the corners of pixels leave room on all sides of their
    /// centres. Keeps a reference to the tracer.
    RegionLedger(const Tracer& tracer, const Silhouette& silhouette,
                 const std::array<glm::dvec3, 4>& corners);
    /// For a part of `outer`'s region: only what reaches that region is considered.
    RegionLedger(const RegionLedger& outer, const std::array<glm::dvec3, 4>& corners);

    /// Ends the volumes where those of `ends` begin, which are those of the casters' triangles
    /// moved away from the light. Crossings of both over one edge are removed, and the light caps
    /// of `ends` become dark caps.
    void cut_off(RegionLedger ends) { ends_ = std::make_shared<RegionLedger>(std::move(ends)); }

    /// One flag per triangle: Crossing::flipped of its light cap. Empty: none. Kept as a reference.
    void flip_caps(std::span<const std::uint8_t> flipped) { flipped_ = flipped; }

    /// Crossings of one ray, by increasing depth from the eye, without sides that cancel. In double
    /// precision with signs that neighbouring faces share, so that a ray leaves a closed volume as
    /// often as it enters it, except where a product rounds to another sign: compare the sum with
    /// the exact counts.
    void crossings(const glm::dvec3& direction, std::vector<Crossing>& found);

    /// Normals of the planes through the eye, and between four rays, that bound faces there: rays
    /// on the same sides of all of them cross the same faces.
    std::vector<glm::dvec3> outlines(const std::array<glm::dvec3, 4>& corners) const;

    /// The same of the lines in which sides that reach to infinity end: they bound what is counted
    /// where no dark caps close the volumes there.
    std::vector<glm::dvec3> vanishing_lines(const std::array<glm::dvec3, 4>& corners) const;

    /// How many sides are seen edge-on within the rectangle of four rays: both the line of their
    /// edges and the vanishing line of their planes pass through it.
    int edge_on_sides(const std::array<glm::dvec3, 4>& corners) const;

    /// Triangles whose light caps some ray of the region may meet.
    std::vector<std::uint32_t> light_caps() const;

private:
    struct Cap {
        std::uint32_t triangle = no_triangle;
        glm::dvec3 plane{0, 0, 0};
        std::array<glm::dvec3, 3> edges{}; ///< as Silhouette::Side::edge
        std::array<bool, 3> reversed{};    ///< the triangle runs the edge the other way
        double eye = 0;                    ///< the eye's side of that plane; positive behind it
        bool is_met_by(const glm::dvec3& direction) const; ///< ahead of the eye or behind it
        bool may_be_met(const std::array<glm::dvec3, 4>& corners) const; ///< anywhere between them
    };

    template <class PlaneOf>
    void gather_sides(const std::vector<Silhouette::Side>& sides, std::size_t vertex_count,
                      const PlaneOf& plane_of, const std::array<glm::dvec3, 4>& corners);
    template <class PlaneOf>
    void number_vertices(const PlaneOf& plane_of);
    void gather_caps(const std::array<glm::dvec3, 4>& corners);
    void gather_cap(std::uint32_t triangle, const std::array<glm::dvec3, 4>& corners);

    /// Vertices of the region's sides, with the components of their planes in separate arrays so
    /// that the compiler can load many at once.
    struct Vertices {
        std::vector<double> x, y, z;
    };

    const Tracer& tracer_;
    Vertices vertices_;
    std::vector<Silhouette::Side> sides_; ///< p and q: indices into vertices_
    std::vector<std::uint8_t> behind_;    ///< one flag per vertex, for the ray at hand
    std::vector<Cap> caps_;
    std::span<const std::uint8_t> flipped_;
    std::shared_ptr<RegionLedger> ends_;
    std::vector<Crossing> found_at_ends_;

    void cross_ends(const glm::dvec3& direction, std::vector<Crossing>& found);
};

} // namespace shadowproof
