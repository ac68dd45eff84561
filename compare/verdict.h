// A cell's verdict: do scene and technique agree, or fail as was predicted?
#pragma once

#include "compare/classify.h"
#include "scenes/scene.h"

#include <span>
#include <string>
#include <string_view>

namespace shadowproof {

enum class Verdict : std::uint8_t {
    agrees,
    fails_as_predicted,
    defect,
    unexplained,
    timed_out, ///< given up before it could be judged
};

std::string_view name_of(Verdict verdict);

/// `fails_at`: the causes the technique is known to have. A cause is excused where the technique
/// has it and the scene declares that it provokes it, or may (a scene that declares nothing may
/// provoke any). `edge` is no failing; `precision` lies in the depth format, and what is in
/// `by_nature` in the technique, so no scene need declare them.
Verdict judge(const Scene& scene, std::span<const Cause> fails_at, std::span<const Cause> by_nature,
              const Comparison& comparison);

/// Which of the causes found are excused so, in the order of all_causes; never edge.
std::vector<Cause> excused_causes(const Scene& scene, std::span<const Cause> fails_at,
                                  std::span<const Cause> by_nature, const Comparison& comparison);

/// Causes that the scene declares, that some technique shown here is known for, and that no
/// comparison found: the scene has stopped provoking them.
std::vector<Cause> no_longer_provoked(std::span<const Cause> provokes,
                                      std::span<const std::vector<Cause>> fails_at,
                                      std::span<const Comparison> comparisons);

} // namespace shadowproof
