#include "compare/verdict.h"

#include "compare/driver/lighting/lighting_arithmetic.h"
#include "compare/evidence.h"

#include <algorithm>

namespace shadowproof {

namespace {

bool contains(std::span<const Cause> causes, Cause cause) {
    return std::find(causes.begin(), causes.end(), cause) != causes.end();
}

bool excused(const Scene& scene, std::span<const Cause> fails_at, std::span<const Cause> by_nature,
             Cause cause) {
    if (!contains(fails_at, cause)) return false;
    return cause == Cause::precision || contains(by_nature, cause) || !scene.declares_provokes ||
           contains(scene.provokes, cause) || contains(scene.may_provoke, cause);
}

} // namespace

std::string_view name_of(Verdict verdict) {
    switch (verdict) {
    case Verdict::agrees:
        return "agrees";
    case Verdict::fails_as_predicted:
        return "fails_as_predicted";
    case Verdict::defect:
        return "defect";
    case Verdict::unexplained:
        return "unexplained";
    case Verdict::timed_out:
        break;
    }
    return "timed_out";
}

std::vector<Cause> known_on(const Scene& scene, const Frame& frame, std::vector<Cause> causes) {
    const bool shades = !frame.color.pixels.empty() && is_off_by_nature(frame.color_model, scene);
    if (shades && !contains(causes, Cause::shading)) causes.push_back(Cause::shading);
    return causes;
}

Verdict judge(const Scene& scene, std::span<const Cause> fails_at, std::span<const Cause> by_nature,
              const Comparison& comparison) {
    const auto found = [&](Cause cause) {
        return comparison.causes[static_cast<std::size_t>(cause)] > 0;
    };
    if (!is_explained(comparison)) return Verdict::unexplained;
    if (comparison.too_near > 0) return Verdict::defect;
    Verdict verdict = Verdict::agrees;
    for (const CauseWords& words : all_causes) {
        if (words.cause == Cause::edge || !found(words.cause)) continue;
        if (!excused(scene, fails_at, by_nature, words.cause)) return Verdict::defect;
        verdict = Verdict::fails_as_predicted;
    }
    return verdict;
}

std::vector<Cause> excused_causes(const Scene& scene, std::span<const Cause> fails_at,
                                  std::span<const Cause> by_nature, const Comparison& comparison) {
    std::vector<Cause> causes;
    for (const CauseWords& words : all_causes) {
        const bool found = comparison.causes[static_cast<std::size_t>(words.cause)] > 0;
        if (words.cause == Cause::precision && comparison.too_near > 0) continue;
        if (found && words.cause != Cause::edge && excused(scene, fails_at, by_nature, words.cause))
            causes.push_back(words.cause);
    }
    return causes;
}

bool is_default_picture(std::span<const std::string> settings) {
    return std::ranges::none_of(settings, [](const std::string& word) {
        return word.starts_with("--") && word != "--gl" && word != "--gate" && word != "--allow" &&
               word != "--timeout";
    });
}

std::vector<Cause> no_longer_provoked(std::span<const Cause> provokes,
                                      std::span<const std::vector<Cause>> fails_at,
                                      const std::function<bool(Cause)>& is_shown) {
    std::vector<Cause> missing;
    for (const Cause cause : provokes) {
        const bool known = std::any_of(fails_at.begin(), fails_at.end(),
                                       [&](const auto& causes) { return contains(causes, cause); });
        if (known && !is_shown(cause)) missing.push_back(cause);
    }
    return missing;
}

} // namespace shadowproof
