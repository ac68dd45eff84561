// The hypotheses of a diagnosis, in groups. Each function adds those of its group to the trial.
#pragma once

#include "compare/picture/light_sampling.h"
#include "compare/picture/trial.h"
#include "compare/picture/volume_counts.h"

#include <span>
#include <vector>

namespace shadowproof {

void try_operations(Trial& trial);  ///< no_shadow, inverted
void try_lights(Trial& trial);      ///< other_light
void try_meshes(Trial& trial);      ///< receiver_missing, caster_missing, mesh_missing
void try_masks(Trial& trial);       ///< alpha_ignored
void try_one_sided(Trial& trial);   ///< one_sided_casters
void try_moved_light(Trial& trial); ///< light_moved

void try_counters(Trial& trial, const VolumeCounts& counts);   ///< missing_cap, stencil_bits
void try_near_plane(Trial& trial, const VolumeCounts& counts); ///< zpass
void try_far_plane(Trial& trial, const VolumeCounts& counts);  ///< zfail_far
void try_length(Trial& trial, const VolumeCounts& counts);     ///< short_volumes

void try_range(Trial& trial);      ///< shadow_map, cut at its range
void try_epsilon(Trial& trial);    ///< ray_epsilon
void try_cube_maps(Trial& trial);  ///< shadow_map of a point light
void try_plane_maps(Trial& trial); ///< shadow_map of a spot, or of a directional light

inline constexpr const char* dark_beyond = ", and all in shadow beyond";

/// Views with a narrow filter, and with a wide one: where shadows are soft, maps without any
/// explain little. None where the picture has no soft shadows.
std::vector<LightSampling> filtered(const Trial& trial, std::span<const LightSampling> views);

/// The map with each filter that is usual; none where the picture has no soft shadows.
std::vector<LightSampling> with_filters(const Trial& trial, const LightSampling& view);

/// How a shadow map is told.
struct MapWords {
    Parameters parameters;
    std::string text;
};
void add_bias(MapWords& words, const MapBias& bias);
void add_culling(MapWords& words, LightSampling::Culled culled);
void add_filter(MapWords& words, const MapFilter& filter);

} // namespace shadowproof
