#include "raster/technique.h"

#include "raster/joined.h"
#include "raster/maps/map_shadows.h"

#include <algorithm>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace shadowproof {

// Each file of techniques/ defines one.
#define SHADOWPROOF_TECHNIQUE(name) Technique name##_technique();
#define SHADOWPROOF_JOINED(lighting, shadowing, cost)
#include "raster/techniques.inc"
#undef SHADOWPROOF_JOINED
#undef SHADOWPROOF_TECHNIQUE

std::span<const Technique> all_techniques() {
    static std::deque<Joined> joined; // whose words stay where they are
    static const std::vector<Technique> techniques{
#define SHADOWPROOF_TECHNIQUE(name) name##_technique(),
#define SHADOWPROOF_JOINED(lighting, shadowing, cost)                                              \
    joined.emplace_back(lighting##_technique(), shadowing##_technique(), cost).technique(),
#include "raster/techniques.inc"
#undef SHADOWPROOF_JOINED
#undef SHADOWPROOF_TECHNIQUE
    };
    return techniques;
}

namespace {

const Technique* registered(std::string_view name) {
    const auto techniques = all_techniques();
    const auto found = std::ranges::find(techniques, name, &Technique::name);
    return found == techniques.end() ? nullptr : &*found;
}

bool lights(const Technique& technique) {
    return technique.lighting != nullptr && technique.name.find('+') == std::string_view::npos;
}
/// Whether it finds each pixel lit or not, and nothing in between, and leaves colours to others.
bool shadows(const Technique& technique) {
    if (technique.lighting != nullptr) return false;
    if (technique.map != nullptr) return technique.map().model.filter == 0;
    return technique.recipe != nullptr && !technique.counts_in_sum;
}

/// Kept once it is asked for, so that its words stay.
const Technique* joined_by_name(std::string_view name) {
    const std::size_t plus = name.find('+');
    if (plus == std::string_view::npos) return nullptr;
    const Technique* lighting = registered(name.substr(0, plus));
    const Technique* shadowing = registered(name.substr(plus + 1));
    if (lighting == nullptr || shadowing == nullptr || !lights(*lighting) || !shadows(*shadowing))
        return nullptr;
    static std::mutex mutex;
    static std::map<std::string, std::unique_ptr<Joined>, std::less<>> known;
    const std::lock_guard lock(mutex);
    std::unique_ptr<Joined>& kept = known[std::string(name)];
    if (!kept) kept = std::make_unique<Joined>(*lighting, *shadowing);
    return &kept->technique();
}

template <class Is>
std::vector<std::string_view> names_of(const Is& is) {
    std::vector<std::string_view> names;
    for (const Technique& technique : all_techniques())
        if (is(technique)) names.push_back(technique.name);
    return names;
}

} // namespace

const Technique* find_technique(std::string_view name) {
    const Technique* found = registered(name);
    return found != nullptr ? found : joined_by_name(name);
}

std::vector<std::string_view> lighting_techniques() {
    return names_of(lights);
}
std::vector<std::string_view> shadowing_techniques() {
    return names_of(shadows);
}

bool suits(const Technique& technique, const Scene& scene) {
    if (technique.map != nullptr && technique.map().model.shape == MapModel::Shape::spot &&
        !std::ranges::all_of(added_lights(technique, scene), fits_one_map))
        return false; // the scene's notes say so
    return can_draw(technique, scene) && (!technique.filters_bumps || asks_for_mipmaps(scene));
}

} // namespace shadowproof
