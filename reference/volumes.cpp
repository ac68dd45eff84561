#include "reference/volumes.h"

#include "scenes/counted_casters.h"
#include "scenes/extrusion.h"
#include "scenes/touching_light.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace shadowproof {

struct Volumes::Variant {
    Scene scene;
    Tracer tracer;
    Silhouette silhouette;

    Variant(Scene variant, int threads)
        : scene(std::move(variant)), tracer(scene, threads), silhouette(tracer) {}
};

namespace {

/// The casters' triangles moved to the volumes' far ends. What faces the light still does, and
/// edges keep their order, so that a side of these is the continuation of the caster's side.
Scene extruded_scene(const Scene& scene, double distance) {
    Scene extruded = scene;
    extruded.positions = extruded_positions(scene, distance);
    return extruded;
}

Image<std::int32_t> difference(Image<std::int32_t> from, const Image<std::int32_t>& what) {
    std::transform(from.pixels.begin(), from.pixels.end(), what.pixels.begin(), from.pixels.begin(),
                   std::minus<>());
    return from;
}

} // namespace

Volumes::Volumes(const Tracer& tracer, const Silhouette& silhouette, const Counting& counting)
    : tracer_(&tracer), silhouette_(&silhouette), ideal_tracer_(&tracer),
      ideal_silhouette_(&silhouette),
      are_ideal_(!counting.holes_filled && !leaves_casters_out(counting) &&
                 !std::isfinite(counting.extrusion)) {
    if (!are_ideal_ && !counting.turned.empty()) {
        Counting as_asked;
        as_asked.turned = counting.turned;
        ideal_ =
            std::make_unique<Variant>(counted_casters(tracer.scene(), as_asked), tracer.threads());
        ideal_tracer_ = &ideal_->tracer;
        ideal_silhouette_ = &ideal_->silhouette;
    }
    if (counting.holes_filled || !counting.turned.empty() || leaves_casters_out(counting))
        others_ =
            std::make_unique<Variant>(counted_casters(tracer.scene(), counting), tracer.threads());
    if (others_) {
        tracer_ = &others_->tracer;
        silhouette_ = &others_->silhouette;
    }
    if (std::isfinite(counting.extrusion))
        ends_ = std::make_unique<Variant>(extruded_scene(casters(), counting.extrusion),
                                          tracer.threads());
    touching_light_ = static_cast<std::int64_t>(triangles_touching_light(casters()).size());
}
Volumes::~Volumes() = default;
Volumes::Volumes(Volumes&&) noexcept = default;

const Scene& Volumes::casters() const {
    return tracer_->scene();
}
int Volumes::threads() const {
    return tracer_->threads();
}

ShadowDepths Volumes::shadow_depths(const GroundTruth& truth, const ShadowDepths& depths) const {
    const ShadowDepths inside = others_ ? count_shadow_depths(*tracer_, truth, depths.far) : depths;
    if (!ends_) return inside;
    const ShadowDepths beyond = count_shadow_depths_at(ends_->tracer, truth.depth, depths.far);
    return {difference(inside.at_surface, beyond.at_surface),
            difference(inside.at_near, beyond.at_near),
            difference(inside.at_far, beyond.at_far),
            difference(inside.at_infinity, beyond.at_infinity),
            inside.at_eye - beyond.at_eye,
            depths.far};
}

const std::vector<glm::vec3>* Volumes::far_ends() const {
    return ends_ ? &ends_->scene.positions : nullptr;
}

RegionLedger Volumes::ideal_ledger(const std::array<glm::dvec3, 4>& corners) const {
    if (are_ideal_) return ledger(corners);
    return {*ideal_tracer_, *ideal_silhouette_, corners};
}

ShadowDepths Volumes::ideal_depths(const GroundTruth& truth, const ShadowDepths& depths) const {
    if (are_ideal_) return shadow_depths(truth, depths);
    return ideal_ ? count_shadow_depths(*ideal_tracer_, truth, depths.far) : depths;
}

RegionLedger Volumes::ledger(const std::array<glm::dvec3, 4>& corners) const {
    RegionLedger ledger(*tracer_, *silhouette_, corners);
    if (ends_) ledger.cut_off(RegionLedger(ends_->tracer, ends_->silhouette, corners));
    return ledger;
}

} // namespace shadowproof
