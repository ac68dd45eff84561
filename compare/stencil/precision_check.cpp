#include "compare/stencil/precision_check.h"

#include "compare/driver/error_bounds.h"
#include "compare/stencil/band.h"
#include "compare/stencil/pixel_readings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>

namespace shadowproof {

namespace {

/// The surface shown at a pixel and the faces of volumes around it, a pixel to each side.
class Surroundings {
public:
    Surroundings(const CountedClaim& judged, PixelPlace p)
        : judged_(judged), place_(p), shown_(judged.frame.triangle.at(p.x, p.y)),
          around_(neighbourhood(judged.traced.scene().camera, {p.x + 0.5, p.y + 0.5},
                                {.surface = 1, .nearest = 1})),
          counted_(drawn().ledger(around_.corners)), ideal_(drawn().ideal_ledger(around_.corners)),
          volumes_{counted_,
                   drawn().casters(),
                   drawn().far_ends(),
                   drawn().are_ideal() ? nullptr : &ideal_,
                   drawn().flat(),
                   judged.prediction.depths().at_eye,
                   judged.prediction.ideal_depths().at_eye,
                   has_masks(judged.traced.scene()) ? &drawn() : nullptr},
          depths_(judged.traced.scene(), {drawn().casters(), drawn().far_ends()}, judged.frame,
                  judged.traced.far(), around_),
          rays_(around_.rays), truth_(traced(rays_)),
          pixel_(judged.tracer(), volumes_, judged.frame, judged.traced.far(), shown_, around_,
                 truth_) {}
    Surroundings(const Surroundings&) = delete; // its parts refer to each other
    Surroundings& operator=(const Surroundings&) = delete;

    /// Of the surface shown, along the pixel's own ray; the far plane's at the background.
    double shown_depth() const {
        const double far = judged_.traced.far();
        return shown_ == no_triangle ? far : std::min(surface_depth(rays_.front()), far);
    }

    /// Adds rays between the outlines of volumes.
    void look_between_outlines() {
        const std::vector<glm::dvec3> between =
            rays_between_outlines(volumes_, judged_.frame, around_);
        const std::vector<RayTruth> truth = traced(between);
        rays_.insert(rays_.end(), between.begin(), between.end());
        truth_.insert(truth_.end(), truth.begin(), truth.end());
    }

    /// Whether some ray has what was read back with all depths of faces exact.
    bool has_exact_reading() const {
        return any_sample([&](const Sample& sample) {
            std::vector<Reading> readings;
            add_sample(pixel_, sample, readings);
            return std::ranges::any_of(readings, [&](const Reading& reading) {
                return !reading.by_depth && explains(judged_, place_, reading);
            });
        });
    }

    /// Whether a face, be it of a flat volume, meets the surface shown, or a clipping plane, within
    /// a pixel; or rounding may displace the line in which both meet by more than a pixel.
    bool may_reorder_a_face() const {
        return any_sample([&](const Sample& sample) {
            return pixel_.flat_volumes_around(sample) > 0 ||
                   std::ranges::any_of(
                       sample.crossings,
                       [&](const Crossing& face) { return meets_clip(face, sample.line); }) ||
                   std::ranges::any_of(pixel_.candidates(sample, pixel_.clip_depths().front()),
                                       [&](const CandidateFace& face) {
                                           return !face.certain &&
                                                  meets_shown(face.crossing, sample.line);
                                       });
        });
    }

private:
    const CountedClaim& judged_;
    PixelPlace place_;
    std::uint32_t shown_;
    Neighbourhood around_;
    RegionLedger counted_;
    RegionLedger ideal_;
    PixelVolumes volumes_;
    FaceDepths depths_;
    std::vector<glm::dvec3> rays_;
    std::vector<RayTruth> truth_; ///< along each ray
    PixelFaces pixel_;

    const Volumes& drawn() const { return judged_.prediction.volumes(); }
    const Scene& scene() const { return judged_.traced.scene(); }
    double surface_depth(const glm::dvec3& ray) const { return plane_depth(scene(), shown_, ray); }

    std::vector<RayTruth> traced(const std::vector<glm::dvec3>& rays) const {
        std::vector<RayTruth> truth;
        for (const glm::dvec3& ray : rays) truth.push_back(trace_ray(judged_.tracer(), ray));
        return truth;
    }

    template <class Predicate>
    bool any_sample(const Predicate& holds) const {
        Sample sample;
        for (std::size_t i = 0; i < rays_.size(); ++i)
            if (pixel_.take(rays_[i], truth_[i], scene().camera.near, sample) && holds(sample))
                return true;
        return false;
    }

    bool meets_clip(const Crossing& face, const glm::dvec3& ray) const {
        return std::ranges::any_of(
            std::array{scene().camera.near, depths_.clip_far()}, [&](double clip) {
                return meets(
                    face, ray, [&](const glm::dvec3& /*ray*/) { return clip; }, 0);
            });
    }

    bool meets_shown(const Crossing& face, const glm::dvec3& ray) const {
        return shown_ != no_triangle &&
               meets(
                   face, ray, [&](const glm::dvec3& at) { return surface_depth(at); },
                   depths_.setup_error_at(shown_, surface_depth(ray)));
    }

    /// Whether the planes of a face, which `ray` meets, and of another meet within the pixel, or
    /// part by less than they may be off all over it. `error_of_other`: of its set-up.
    bool meets(const Crossing& face, const glm::dvec3& ray,
               const std::function<double(const glm::dvec3& at)>& depth_of_other,
               double error_of_other) const {
        const auto gap = [&](const glm::dvec3& at) {
            return face_depth(scene().camera, face, ray, at) - depth_of_other(at);
        };
        double least = gap(ray);
        double most = least;
        for (const glm::dvec3& corner : around_.corners) {
            least = std::min(least, gap(corner));
            most = std::max(most, gap(corner));
        }
        if (least <= 0 && most >= 0) return true;
        const double error = error_of_other + depths_.setup_error_at(face) +
                             stored_depth_error(judged_.frame.depth_model, face.depth);
        return most - least <= error && std::min(std::abs(least), std::abs(most)) <= error;
    }
};

} // namespace

bool is_too_near(const CountedClaim& judged, PixelPlace p) {
    Surroundings here(judged, p);
    const auto has_reason = [&] { return here.has_exact_reading() || here.may_reorder_a_face(); };
    if (!judged.sufficient.contains(here.shown_depth()) || has_reason()) return false;
    here.look_between_outlines();
    return !has_reason();
}

} // namespace shadowproof
