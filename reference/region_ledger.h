// The ledgers of all eye rays of a small region of the picture: only the silhouettes of the shadow
// volumes are asked, and few of them reach one region. A hundred times faster than ray by ray.
#pragma once

#include "reference/ledger.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <utility>
#include <vector>

namespace shadowproof {

/// The silhouette edges of a scene as its light sees them: made once, for all regions.
class Silhouette {
public:
    explicit Silhouette(const Tracer& tracer);

    /// A side of the shadow volumes, over the edge from vertex p to q, p before q.
    struct Side {
        std::uint32_t p = 0; ///< indices into vertices
        std::uint32_t q = 0;
        int surplus = 0; ///< how many sides lie there; negative where they run from p to q
        std::uint32_t triangle = no_triangle; ///< the first that has it
        Crossing::Part part = Crossing::Part::side_0;
        std::uint32_t number = 0;  ///< of this side, in the order of all
        bool turned = false;       ///< as Crossing::turned
        glm::dvec3 plane{0, 0, 0}; ///< as side_plane gives it
        double eye = 0;            ///< the eye against that plane
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

/// Pixels along the side of the regions into which a picture is divided: measured, 8 and 32 take a
/// third longer.
inline constexpr int region_side = 16;

class RegionLedger {
public:
    /// `corners`: directions of four rays of the picture whose rectangle holds all that are asked
    /// for, as corner_rays gives them: the corners of pixels leave room on all sides of their
    /// centres. Keeps a reference to the tracer.
    RegionLedger(const Tracer& tracer, const Silhouette& silhouette,
                 const std::array<glm::dvec3, 4>& corners);
    /// For a part of `outer`'s region: only what reaches that is looked at.
    RegionLedger(const RegionLedger& outer, const std::array<glm::dvec3, 4>& corners);

    /// Ends the volumes where those of `ends` begin, the casters' triangles moved away from the
    /// light: what a ray crosses of both over one edge goes, and the light caps of `ends` are left
    /// as dark caps.
    void cut_off(RegionLedger ends) { ends_ = std::make_shared<RegionLedger>(std::move(ends)); }

    /// Crossings of one ray by increasing depth from the eye on, sides that cancel left out. Double
    /// precision with signs that neighbouring faces share, so that a closed volume is left as often
    /// as it is entered but where a product rounds to another sign: compare the sum with the exact
    /// counts.
    void crossings(const glm::dvec3& direction, std::vector<Crossing>& found);

    /// Normals of the planes through the eye that pass between four rays and bound faces there:
    /// rays on the same sides of all of them cross the same faces.
    std::vector<glm::dvec3> outlines(const std::array<glm::dvec3, 4>& corners) const;

    /// How many sides are seen edge-on within the rectangle of four rays: both the line of their
    /// edges and the line in which their planes vanish pass through it.
    int edge_on_sides(const std::array<glm::dvec3, 4>& corners) const;

private:
    struct Cap {
        std::uint32_t triangle = no_triangle;
        glm::dvec3 plane{0, 0, 0};
        std::array<glm::dvec3, 3> edges{}; ///< as Silhouette::Side::edge
        std::array<bool, 3> turned{};      ///< the triangle runs through the edge the other way
        double eye = 0;                    ///< the eye against that plane; positive behind it
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

    /// Vertices of the region's sides, their planes apart by component so that the compiler asks
    /// for many at once.
    struct Vertices {
        std::vector<double> x, y, z;
    };

    const Tracer& tracer_;
    Vertices vertices_;
    std::vector<Silhouette::Side> sides_; ///< p and q: indices into vertices_
    std::vector<std::uint8_t> behind_;    ///< one flag per vertex, for the ray at hand
    std::vector<Cap> caps_;
    std::shared_ptr<RegionLedger> ends_;
    std::vector<Crossing> found_at_ends_;

    void cross_ends(const glm::dvec3& direction, std::vector<Crossing>& found);
};

} // namespace shadowproof
