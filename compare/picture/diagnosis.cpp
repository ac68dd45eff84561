#include "compare/picture/diagnosis.h"

#include "compare/picture/hypotheses.h"

#include <functional>

namespace shadowproof {

Diagnosed diagnose(const TracedScene& traced, const Frame& frame,
                   const Image<std::uint8_t>& cause) {
    constexpr std::size_t most = 5;
    Trial trial(traced, frame, cause);
    if (trial.wrong() == 0) return {{}, Image<std::uint8_t>(cause.width, cause.height)};
    const VolumeCounts counts(traced);
    using Try = std::function<void()>;
    const auto try_volumes = [&] {
        for (const auto try_one : {try_counters, try_near_plane, try_far_plane, try_length})
            if (!trial.is_settled()) try_one(trial, counts);
    };
    // The cheap ones first: once one explains all and contradicts nothing, no other is tried.
    for (const Try& attempt : std::initializer_list<Try>{
             [&] { try_operations(trial); }, [&] { try_lights(trial); }, [&] { try_meshes(trial); },
             [&] { try_masks(trial); }, [&] { try_one_sided(trial); }, try_volumes,
             [&] { try_range(trial); }, [&] { try_epsilon(trial); }, [&] { try_cube_maps(trial); },
             [&] { try_plane_maps(trial); }, [&] { try_moved_light(trial); }})
        if (!trial.is_settled()) attempt();
    return trial.best(most);
}

} // namespace shadowproof
