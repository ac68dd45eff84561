// The entry to reference/: the ground truth at each pixel centre, decided by the signs of exact
// expressions.
#pragma once

#include "reference/exact/exactness.h"
#include "reference/exact/mask_reading.h"
#include "scenes/frame.h"
#include "scenes/image.h"
#include "scenes/scene.h"

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace shadowproof {

struct TraceStatistics {
    double milliseconds = 0;           ///< tracing alone
    double build_milliseconds = 0;     ///< of what Embree walks
    std::uint64_t rays = 0;            ///< eye rays and shadow rays
    std::uint64_t exact_decisions = 0; ///< signs of what is met that took exact arithmetic
    /// How often floats left a triangle undecided: a measure of cost, which may differ a little
    /// from one instruction set to another, and so is in no report.
    std::uint64_t undecided = 0;
    std::uint64_t lit = 0;
    std::uint64_t shadowed = 0;
    std::uint64_t background = 0;
    std::uint64_t degenerate = 0;
};

struct GroundTruth {
    Image<Visibility> visibility;
    Image<std::uint32_t> triangle; ///< the visible one, or no_triangle
    Image<double> depth; ///< view depth of the visible point, rounded; infinity: background
    Image<Exactness> exactness;
    Image<std::uint8_t> in_cone; ///< 1 where the visible point is in the spot light's cone;
                                 ///< empty where the light is no spot
    TraceStatistics statistics;
};

/// A scene prepared for tracing: its trees, light and camera. Keeps a reference to the scene.
class Tracer {
public:
    /// threads 0: one per core. Coordinates must be finite. Throws Error where there are no
    /// triangles.
    explicit Tracer(const Scene& scene, int threads = 0);
    ~Tracer();
    Tracer(Tracer&&) noexcept;
    Tracer& operator=(Tracer&&) noexcept;
    Tracer(const Tracer&) = delete;
    Tracer& operator=(const Tracer&) = delete;

    const Scene& scene() const;
    int threads() const;

    struct State; ///< for the rooms of reference/ only
    const State& state() const { return *state_; }

private:
    std::unique_ptr<State> state_;
};

/// The ground truth of the picture; the same, bit for bit, for any number of threads and any
/// instruction set, and but for `exactness` and its counts without filters.
GroundTruth trace(const Tracer& tracer, Filters filters = Filters::on);

/// The truth along a line of sight, as line_of_sight (camera.h) gives it.
struct RayTruth {
    Visibility visibility = Visibility::background;
    std::uint32_t triangle = no_triangle;
    double depth = 0;
    Exactness exactness = Exactness::filtered;
    bool in_cone = true; ///< false where the visible point is outside the spot light's cone
};
RayTruth trace_ray(const Tracer& tracer, const glm::dvec3& line);

/// By how much another program may misread a triangle's mask along a line of sight.
class MaskErrors {
public:
    MaskErrors() = default;
    MaskErrors(const MaskErrors&) = delete;
    MaskErrors& operator=(const MaskErrors&) = delete;
    virtual ~MaskErrors() = default;
    /// Called by several threads at once.
    virtual MaskError at(std::uint32_t triangle, const glm::dvec3& line) const = 0;
};
/// How another program may read the masks of what the eye sees, ray by ray.
struct MaskLeeway {
    std::span<const MaskReading> readings; ///< one per ray; empty: all are exact
    const MaskErrors* errors = nullptr;
};

/// View depths between which surfaces are seen.
struct SeenRange {
    double near = 0;
    double far = std::numeric_limits<double>::infinity();
    bool operator==(const SeenRange&) const = default;
};
SeenRange range_of(const Camera& camera);

/// The truth along many lines of sight, on all threads.
std::vector<RayTruth> trace_rays(const Tracer& tracer, std::span<const glm::dvec3> lines,
                                 const MaskLeeway& leeway = {});
/// The same between other planes than the camera's.
std::vector<RayTruth> trace_rays(const Tracer& tracer, std::span<const glm::dvec3> lines,
                                 const MaskLeeway& leeway, const SeenRange& range);

/// The lowest-numbered triangle between what a ray sees and the light; no_triangle where there is
/// none, or nothing is seen, or its side that is seen is turned away from the light.
std::uint32_t occluder_of(const Tracer& tracer, const glm::dvec3& line);

/// What is seen along each line of sight, whether or not it is lit: the nearest triangle and its
/// view depth, no_triangle and infinity where there is none.
struct SeenSurface {
    std::uint32_t triangle = no_triangle;
    double depth = 0;
};
std::vector<SeenSurface> see_rays(const Tracer& tracer, std::span<const glm::dvec3> lines,
                                  const MaskLeeway& leeway = {});

/// The triangles that so many lines of sight meet first, of which nothing is kept: `line` gives
/// each by its index, `found` takes what is seen along it, both on all threads.
void see_triangles(const Tracer& tracer, const SeenRange& range, std::size_t rays,
                   const std::function<glm::dvec3(std::size_t)>& line,
                   const std::function<void(std::size_t, std::uint32_t)>& found);

/// Which sides of a triangle the eye and the light see, exactly: a sign of zero is neither.
struct TriangleSides {
    bool front_to_eye = false;
    bool back_to_eye = false;
    bool front_to_light = false;
    bool back_to_light = false;
    bool visible = false; ///< the side towards the eye is drawn

    /// Whether eye and light are strictly on the same side: only then may the light pass light it.
    bool faces_light() const {
        return (front_to_eye && front_to_light) || (back_to_eye && back_to_light);
    }
};
TriangleSides sides_of(const Tracer& tracer, std::uint32_t triangle);

/// Version of the Embree library in use, "3.13.5".
std::string embree_version();
/// What to say of a version whose walk was not looked into; nothing of the one that was.
std::optional<std::string> note_on_embree(const std::string& version);

} // namespace shadowproof
