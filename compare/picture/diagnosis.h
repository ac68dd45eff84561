// Why a picture's shadows are wrong: hypotheses, each predicted from the exact reference for the
// whole picture and fitted to its wrong pixels.
#pragma once

#include "reference/predict/traced_scene.h"
#include "scenes/frame.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace shadowproof {

struct Diagnosis {
    /// "no_shadow", "inverted", "other_light", "light_moved", "caster_missing",
    /// "receiver_missing", "mesh_missing", "alpha_ignored", "one_sided_casters", "zpass",
    /// "zfail_far", "short_volumes", "missing_cap", "stencil_bits", "shadow_map", "ray_epsilon"
    std::string hypothesis;
    std::vector<std::pair<std::string, double>> parameters; ///< "range", 12
    std::uint64_t explained = 0;                            ///< wrong pixels that it predicts
    std::uint64_t contradicted = 0; ///< right pixels that it predicts to be wrong
    std::string words;              ///< "the shadow of `lamp` is missing"
};

struct Diagnosed {
    /// Those that explain more wrong pixels than they contradict right ones, best first.
    std::vector<Diagnosis> hypotheses;
    /// 1 where a pixel is wrong and the first hypothesis does not explain it.
    Image<std::uint8_t> left;
};

/// `frame`: of family "picture"; `cause`: Comparison::cause. Five hypotheses at most, none where
/// only pixels at edges are wrong.
Diagnosed diagnose(const TracedScene& traced, const Frame& frame, const Image<std::uint8_t>& cause);

} // namespace shadowproof
