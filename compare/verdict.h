// A cell's verdict: whether the technique agrees with the truth on the scene, or fails as
// predicted.
#pragma once

#include "compare/classify.h"
#include "scenes/scene.h"

#include <functional>
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

/// A technique's known causes (fails_at, or by_nature), and `shading` where its frame lights bumps
/// in a way that is off by nature on the scene (is_off_by_nature): the user may ask any technique
/// that lights bumps for that, and heights in units of space make it so.
std::vector<Cause> known_on(const Scene& scene, const Frame& frame, std::vector<Cause> causes);

/// `fails_at`: the causes the technique is known to have on the scene. A cause is excused where the
/// technique has it and the scene declares that it provokes it, or may (a scene that declares
/// nothing may provoke any). `edge` is not a failure. No scene need declare `precision`, which lies
/// in the depth format, or the causes in `by_nature`, which lie in the technique. Nearer than the
/// depth to which a technique's numbers suffice, `precision` is a defect (Comparison::too_near).
Verdict judge(const Scene& scene, std::span<const Cause> fails_at, std::span<const Cause> by_nature,
              const Comparison& comparison);

/// The causes found that are excused so, in the order of all_causes; never edge.
std::vector<Cause> excused_causes(const Scene& scene, std::span<const Cause> fails_at,
                                  std::span<const Cause> by_nature, const Comparison& comparison);

/// Whether a run with these settings, words of a command line, shows what the bundled scenes are
/// made to provoke: none of them changes picture or technique.
bool is_default_picture(std::span<const std::string> settings);

/// Causes that the scene declares, that some technique tried is known for, and that no cell shows:
/// the scene has stopped provoking them. `fails_at`: of each technique tried.
std::vector<Cause> no_longer_provoked(std::span<const Cause> provokes,
                                      std::span<const std::vector<Cause>> fails_at,
                                      const std::function<bool(Cause)>& is_shown);

} // namespace shadowproof
