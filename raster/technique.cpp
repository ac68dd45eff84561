#include "raster/technique.h"

#include "raster/joined.h"
#include "raster/maps/map_shadows.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace shadowproof {

// Each file of techniques/ defines one.
#define SHADOWPROOF_TECHNIQUE(name) Technique name##_technique();
#include "raster/techniques.inc"
#undef SHADOWPROOF_TECHNIQUE

std::span<const Technique> all_techniques() {
    static const std::array techniques{
#define SHADOWPROOF_TECHNIQUE(name) name##_technique(),
#include "raster/techniques.inc"
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

bool is_joined(const Technique& technique) {
    return technique.name.find('+') != std::string_view::npos;
}
bool lights(const Technique& technique) {
    return technique.lighting != nullptr && !is_joined(technique);
}
/// Whether it finds each pixel lit or not, and nothing in between.
bool shadows(const Technique& technique) {
    if (technique.map != nullptr) return technique.map().model.filter == 0;
    return technique.recipe != nullptr && technique.lighting == nullptr && !technique.counts_in_sum;
}

/// A technique whose words are its own.
struct Joined {
    std::string name;
    std::string summary;
    std::string source;
    std::string needs;
    Technique technique;

    Joined(const Technique& lighting, const Technique& shadowing)
        : name(std::string(lighting.name) + "+" + std::string(shadowing.name)),
          summary(std::string(shadowing.name) + ", and bumps lit as by " +
                  std::string(lighting.name)),
          source(std::string(lighting.source) + "; " + std::string(shadowing.source)),
          needs(std::string(shadowing.needs) + "; " + std::string(lighting.needs)),
          technique(joined_technique(lighting, shadowing)) {
        technique.name = name;
        technique.summary = summary;
        technique.source = source;
        technique.needs = needs;
    }
    Joined(const Joined&) = delete;
    Joined& operator=(const Joined&) = delete;
};

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
    return &kept->technique;
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

} // namespace shadowproof
