#include "reference/predict/tally.h"

#include <limits>

namespace shadowproof {

std::string_view name_of(Tally tally) {
    switch (tally) {
    case Tally::counted:
        return "counted";
    case Tally::beyond:
        return "beyond";
    case Tally::lost_near:
        return "lost_near";
    case Tally::lost_far:
        return "lost_far";
    case Tally::lost_cap:
        break;
    }
    return "lost_cap";
}

Tally tally(const Crossing& crossing, double surface, std::uint32_t seen, double far,
            const Counting& counting, const DepthModel& depth_model) {
    if (seen == no_triangle)
        surface = depth_model.background_at_far() ? far : std::numeric_limits<double>::infinity();
    const bool own = crossing.triangle == seen && crossing.part == Crossing::Part::light_cap;
    const bool in_front = !own && crossing.depth < surface;
    const Counting::Caster caster = counting.caster(crossing.triangle);
    const bool asked_for = in_front == (caster.test == Counting::Test::depth_pass);
    if (!asked_for) return Tally::beyond;
    if (in_front && !depth_model.clamp && crossing.depth < depth_model.near)
        return Tally::lost_near;
    if (!in_front && depth_model.clips_at_far() && crossing.depth >= far) return Tally::lost_far;
    if (crossing.part == Crossing::Part::light_cap && !caster.light_cap) return Tally::lost_cap;
    if (crossing.part == Crossing::Part::dark_cap && !caster.dark_cap) return Tally::lost_cap;
    return Tally::counted;
}

Tally tally_of_dark_caps(const Counting& counting, const DepthModel& depth_model) {
    if (counting.test == Counting::Test::depth_pass) return Tally::beyond;
    if (depth_model.clips_at_far()) return Tally::lost_far;
    return counting.dark_cap ? Tally::counted : Tally::lost_cap;
}

std::int64_t dark_caps_at_infinity(const Counting& counting, std::int32_t at_eye,
                                   std::span<const Crossing> crossings) {
    std::int64_t inside = at_eye;
    for (const Crossing& crossing : crossings)
        if (counting.casters.empty() || weight(counting, crossing) < 0) inside += crossing.change;
    return inside;
}

} // namespace shadowproof
