#include "reference/predict/volumes.h"

#include "reference/trace/shells.h"
#include "scenes/mesh/extrusion.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
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

/// The casters' triangles moved to the volumes' far ends. Those that face the light still do, and
/// edges keep their order, so that a side of these continues the caster's side.
Scene extruded_scene(const Scene& scene, double distance) {
    Scene extruded = scene;
    extruded.positions = extruded_positions(scene, distance);
    return extruded;
}

/// Flagged triangles with their first two corners exchanged.
Scene with_flipped(const Scene& scene, const std::vector<std::uint8_t>& flipped) {
    Scene casters = scene;
    for (std::size_t triangle = 0; triangle < flipped.size(); ++triangle)
        if (flipped[triangle] != 0)
            std::swap(casters.triangles[triangle].x, casters.triangles[triangle].y);
    return casters;
}

/// Appends them as a mesh that only casts.
void add_lids(Scene& casters, const std::vector<glm::uvec3>& lids) {
    if (lids.empty()) return;
    const auto whole = static_cast<std::uint32_t>(casters.materials.size());
    casters.materials.emplace_back().name = "filled holes";
    casters.meshes.push_back(
        {.name = "filled holes",
         .first_triangle = static_cast<std::uint32_t>(casters.triangles.size()),
         .triangle_count = static_cast<std::uint32_t>(lids.size()),
         .material = whole});
    casters.triangles.insert(casters.triangles.end(), lids.begin(), lids.end());
}

bool leaves_casters_out(const Counting& counting) {
    return std::any_of(counting.casters.begin(), counting.casters.end(),
                       [](const Counting::Caster& caster) { return caster.left_out; });
}

/// A mesh is left out as a whole or not at all.
void leave_out(Scene& casters, const Counting& counting) {
    for (Mesh& mesh : casters.meshes)
        if (mesh.triangle_count > 0 && counting.caster(mesh.first_triangle).left_out)
            mesh.casts = false;
}

Image<std::int32_t> difference(Image<std::int32_t> from, const Image<std::int32_t>& what) {
    std::transform(from.pixels.begin(), from.pixels.end(), what.pixels.begin(), from.pixels.begin(),
                   std::minus<>());
    return from;
}

} // namespace

Volumes::Volumes(const Tracer& tracer, const Silhouette& silhouette, const Counting& counting)
    : tracer_(&tracer), silhouette_(&silhouette), ideal_tracer_(&tracer),
      ideal_silhouette_(&silhouette), flipped_(flipped_triangles(tracer, counting.flips)),
      are_ideal_(!counting.holes_filled && !leaves_casters_out(counting) &&
                 !std::isfinite(counting.extrusion)) {
    const Scene& scene = tracer.scene();
    if (!are_ideal_ && !flipped_.empty()) {
        ideal_ = std::make_unique<Variant>(with_flipped(scene, flipped_), tracer.threads());
        ideal_tracer_ = &ideal_->tracer;
        ideal_silhouette_ = &ideal_->silhouette;
    }
    if (counting.holes_filled || !flipped_.empty() || leaves_casters_out(counting)) {
        Scene casters = with_flipped(scene, flipped_);
        if (counting.holes_filled) add_lids(casters, lids_of(scene));
        leave_out(casters, counting);
        others_ = std::make_unique<Variant>(std::move(casters), tracer.threads());
        tracer_ = &others_->tracer;
        silhouette_ = &others_->silhouette;
    }
    if (!std::isfinite(counting.extrusion)) return;
    flat_ = flat_volumes(casters(), extruded_positions(casters(), counting.extrusion));
    if (!flat_.empty()) {
        drawn_ = std::make_unique<Scene>(casters());
        others_ = std::make_unique<Variant>(without(casters(), flat_), tracer.threads());
        tracer_ = &others_->tracer;
        silhouette_ = &others_->silhouette;
    }
    ends_ =
        std::make_unique<Variant>(extruded_scene(casters(), counting.extrusion), tracer.threads());
    depths_ = {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const std::vector<glm::vec3>* positions : {&casters().positions, far_ends()})
        for (const glm::dvec3 position : *positions) {
            const double depth = view_depth(casters().camera, position);
            depths_.least = std::min(depths_.least, depth);
            depths_.most = std::max(depths_.most, depth);
        }
    const double room = depths_.most - depths_.least; // for roundings; the others are far beyond
    depths_ = {depths_.least - room, depths_.most + room};
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
    ShadowDepths between{difference(inside.at_surface, beyond.at_surface),
                         difference(inside.at_near, beyond.at_near),
                         difference(inside.at_far, beyond.at_far),
                         difference(inside.at_infinity, beyond.at_infinity),
                         inside.at_eye - beyond.at_eye,
                         depths.far};
    // Finite volumes hold neither end of parallel lines of sight, whatever rounding makes of ends
    // that lie in line with them.
    if (casters().camera.is_orthographic()) {
        between.at_eye = 0;
        std::ranges::fill(between.at_infinity.pixels, 0);
    }
    return between;
}

const std::vector<glm::vec3>* Volumes::far_ends() const {
    return ends_ ? &ends_->scene.positions : nullptr;
}

RegionLedger Volumes::ideal_ledger(const std::array<glm::dvec3, 4>& corners) const {
    if (are_ideal_) return ledger(corners);
    RegionLedger ledger(*ideal_tracer_, *ideal_silhouette_, corners);
    ledger.flip_caps(flipped_);
    return ledger;
}

ShadowDepths Volumes::ideal_depths(const GroundTruth& truth, const ShadowDepths& depths) const {
    if (are_ideal_) return shadow_depths(truth, depths);
    return ideal_ ? count_shadow_depths(*ideal_tracer_, truth, depths.far) : depths;
}

RegionLedger Volumes::ledger(const std::array<glm::dvec3, 4>& corners) const {
    RegionLedger ledger(*tracer_, *silhouette_, corners);
    ledger.flip_caps(flipped_);
    if (ends_)
        ledger.cut_off(RegionLedger(ends_->tracer, ends_->silhouette, corners),
                       casters().camera.is_orthographic() ? depths_ : DepthSpan{});
    return ledger;
}

} // namespace shadowproof
