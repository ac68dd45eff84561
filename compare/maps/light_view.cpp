#include "compare/maps/light_view.h"

#include "compare/maps/parallel_view.h"
#include "compare/maps/perspective_view.h"
#include "scenes/roundoff.h"

#include <algorithm>
#include <cmath>

namespace shadowproof {

namespace {

/// How many steps a format of whole numbers has.
double steps_of(MapFormat format) {
    if (format == MapFormat::ramp8) return ramp_steps - 1;
    return format == MapFormat::d24 ? 0xffffff : 0xffff;
}

} // namespace

LightView::LightView(const Scene& scene, const MapEvidence& map)
    : map_(map), has_format_(map.format == depth_format_of(map.model.format)),
      steps_(map.model.format == MapFormat::d32f ? 0 : steps_of(map.model.format)) {
    for (std::size_t face = 0; face < map.model.faces(); ++face)
        cameras_.push_back(map_camera(chosen_light(scene), map.model, face));
}

// A whole number of steps, which comes back as a float: rounded twice where it is multiplied by a
// rounded reciprocal, as llvmpipe does of 8 and 16 bits.
bool LightView::is_in_format(float stored) const {
    if (!has_format_ || !(stored >= 0 && stored <= 1)) return false;
    if (steps_ == 0) return true;
    const double steps = double{stored} * steps_;
    const double nearest = static_cast<int>(steps + 0.5); // quicker than std::round
    return std::abs(steps - nearest) <= 2 * float_roundoff * steps;
}

double LightView::half_step() const {
    return steps_ == 0 ? 0 : 0.5 / steps_;
}

double LightView::moved_by(double depth, double offset) const {
    if (offset == 0) return depth;
    return value_of_stored(model(), std::min(map_window_depth(model(), depth) + offset, 1.0));
}

std::optional<std::uint32_t> LightView::shown(const Texel& texel, std::uint32_t at_centre) const {
    if (!is_in_format(stored(texel))) return std::nullopt;
    if (at_centre == no_triangle ? stored(texel) == 1 : may_show(texel, at_centre))
        return at_centre;
    return shown_around(texel);
}

Scene casters_alone(const Scene& scene, bool double_sided, std::vector<std::uint32_t>& of_scene) {
    const std::vector<std::uint8_t> casts = casting_triangles(scene);
    Scene casters;
    casters.name = scene.name;
    casters.positions = scene.positions;
    casters.mask_at = scene.mask_at;
    casters.masks = scene.masks;
    casters.lights = {chosen_light(scene)};
    casters.materials = {{.name = "caster", .double_sided = double_sided}};
    for (std::uint32_t mask = 0; mask < scene.masks.size(); ++mask)
        casters.materials.push_back(
            {.name = "masked caster", .double_sided = double_sided, .mask = mask});
    of_scene.clear();
    const std::vector<std::uint32_t> masks = masks_of_triangles(scene);
    for (std::uint32_t triangle = 0; triangle < scene.triangles.size(); ++triangle) {
        if (casts[triangle] == 0) continue;
        const std::uint32_t mask = masks.empty() ? no_mask : masks[triangle];
        const std::uint32_t material = mask == no_mask ? 0 : mask + 1;
        if (casters.meshes.empty() || casters.meshes.back().material != material)
            casters.meshes.push_back(
                {.name = "casters",
                 .first_triangle = static_cast<std::uint32_t>(casters.triangles.size()),
                 .material = material});
        ++casters.meshes.back().triangle_count;
        casters.triangles.push_back(scene.triangles[triangle]);
        of_scene.push_back(triangle);
    }
    return casters;
}

std::vector<std::uint32_t> inverse_of(std::span<const std::uint32_t> of_scene,
                                      std::size_t triangles) {
    std::vector<std::uint32_t> place(triangles, no_triangle);
    for (std::uint32_t i = 0; i < of_scene.size(); ++i) place[of_scene[i]] = i;
    return place;
}

std::unique_ptr<LightView> light_view(const Scene& scene, const MapEvidence& map, int subpixel_bits,
                                      int threads) {
    if (map.model.shape == MapModel::Shape::sun)
        return std::make_unique<ParallelView>(scene, map, subpixel_bits, threads);
    return std::make_unique<PerspectiveView>(scene, map, subpixel_bits, threads);
}

} // namespace shadowproof
