// The ledgers of all eye rays in a small region of the picture: only the silhouettes of the shadow
// volumes are tested, of which few reach one region. A hundred times faster than ray by ray.
#pragma once

#include "reference/predict/ledger.h"
#include "reference/predict/sight_plane.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace shadowproof {

/// View depths from the least to the most; all of them.
struct DepthSpan {
    double least = -std::numeric_limits<double>::infinity();
    double most = std::numeric_limits<double>::infinity();
};

/// The plane of a face of the volumes, as lines of sight meet it.
struct FacePlane {
    glm::dvec3 normal{0, 0, 0}; ///< of any length
    double eye = 0;             ///< the eye's side of it, with an exact sign; never 0
    glm::dvec3 point{0, 0, 0};  ///< of the plane
};

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
        std::uint32_t number = 0; ///< of this side, in the order of all
        bool flipped = false;     ///< as Crossing::flipped
        FacePlane plane;          ///< its normal as side_plane gives it
        SightPlane edge;          ///< through the edge
    };
    struct Vertex {
        glm::dvec3 position{0, 0, 0};
        SightPlane plane; ///< through it and the light
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
    /// `corners`: four lines of sight of the picture whose rectangle contains all that are to be
    /// queried, as from corner_lines: the corners of pixels leave room on all sides of their
    /// centres. Keeps a reference to the tracer.
    RegionLedger(const Tracer& tracer, const Silhouette& silhouette,
                 const std::array<glm::dvec3, 4>& corners);
    /// For a part of `outer`'s region: only what reaches that region is considered.
    RegionLedger(const RegionLedger& outer, const std::array<glm::dvec3, 4>& corners);

    /// Ends the volumes where those of `ends` begin, which are those of the casters' triangles
    /// moved away from the light. Crossings of both over one edge are removed, and the light caps
    /// of `ends` become dark caps. `span`: view depths between which all of them lie; sides that
    /// would be crossed elsewhere are not crossed.
    void cut_off(RegionLedger ends, const DepthSpan& span) {
        ends_ = std::make_shared<RegionLedger>(std::move(ends));
        span_ = span;
    }

    /// One flag per triangle: Crossing::flipped of its light cap. Empty: none. Kept as a reference.
    void flip_caps(std::span<const std::uint8_t> flipped) { flipped_ = flipped; }

    /// Crossings of one line of sight, by increasing depth from the eye, without sides that cancel.
    /// In double precision with signs that neighbouring faces share, so that a ray leaves a closed
    /// volume as often as it enters it, except where a product rounds to another sign: compare the
    /// sum with the exact counts. Where lines of sight are parallel, they come from the eye at
    /// infinity: depths may be negative, and infinite on sides that the lines are parallel to.
    void crossings(const glm::dvec3& line, std::vector<Crossing>& found);

    /// The planes between four lines of sight that bound faces there: lines on the same sides of
    /// all of them cross the same faces.
    std::vector<SightPlane> outlines(const std::array<glm::dvec3, 4>& corners) const;

    /// The same of the lines in which sides that reach to infinity end: they bound what is counted
    /// where no dark caps close the volumes there.
    std::vector<SightPlane> vanishing_lines(const std::array<glm::dvec3, 4>& corners) const;

    /// How many sides are seen edge-on within the rectangle of four lines of sight: both the line
    /// of their edges and the vanishing line of their planes pass through it. Parallel lines of
    /// sight have no such line, and see a side between two lines away from the light: it is both of
    /// these.
    int edge_on_sides(const std::array<glm::dvec3, 4>& corners) const;

    /// Triangles whose light caps some ray of the region may meet.
    std::vector<std::uint32_t> light_caps() const;

private:
    struct Cap {
        std::uint32_t triangle = no_triangle;
        FacePlane plane;                              ///< the eye's side is positive behind it
        std::array<SightPlane, 3> edges{};            ///< as Silhouette::Side::edge
        std::array<bool, 3> reversed{};               ///< the triangle runs the edge the other way
        bool is_met_by(const glm::dvec3& line) const; ///< ahead of the eye or behind it
        bool may_be_met(const std::array<glm::dvec3, 4>& corners) const; ///< anywhere between them
    };

    template <class PlaneOf>
    void gather_sides(const std::vector<Silhouette::Side>& sides, std::size_t vertex_count,
                      const PlaneOf& plane_of, const std::array<glm::dvec3, 4>& corners);
    template <class PlaneOf>
    void number_vertices(const PlaneOf& plane_of);
    void gather_caps(const std::array<glm::dvec3, 4>& corners);
    void gather_cap(std::uint32_t triangle, const std::array<glm::dvec3, 4>& corners);

    /// Where a line of sight meets a plane ahead of the eye.
    struct Meeting {
        double depth = 0;
        bool along_normal = false; ///< it runs to that side
    };
    std::optional<Meeting> meet(const FacePlane& plane, const glm::dvec3& line) const;

    /// Vertices of the region's sides, with the components of their planes in separate arrays so
    /// that the compiler can load many at once.
    struct Vertices {
        std::vector<double> x, y, z, offset;
        SightPlane plane(std::size_t i) const { return {{x[i], y[i], z[i]}, offset[i]}; }
    };

    const Tracer& tracer_;
    bool is_parallel_;
    Vertices vertices_;
    std::vector<Silhouette::Side> sides_; ///< p and q: indices into vertices_
    std::vector<std::uint8_t> behind_;    ///< one flag per vertex, for the ray at hand
    std::vector<Cap> caps_;
    std::span<const std::uint8_t> flipped_;
    std::shared_ptr<RegionLedger> ends_;
    DepthSpan span_{};
    std::vector<Crossing> found_at_ends_;

    void cross_ends(const glm::dvec3& line, std::vector<Crossing>& found);
};

} // namespace shadowproof
