#include "raster/joined.h"

#include <algorithm>

namespace shadowproof {

namespace {

template <class T>
void unite(std::vector<T>& all, const std::vector<T>& more) {
    for (const T& each : more)
        if (std::ranges::find(all, each) == all.end()) all.push_back(each);
}

} // namespace

Technique joined_technique(const Technique& lighting, const Technique& shadowing) {
    Technique technique = shadowing;
    technique.cost = 0;
    technique.needs_bump_maps = lighting.needs_bump_maps;
    technique.needs_environment = lighting.needs_environment;
    technique.squares_thrice = lighting.squares_thrice;
    technique.lighting = lighting.lighting;
    unite(technique.fails_at, lighting.by_nature); // what it fails at beside what it counts by
    unite(technique.by_nature, lighting.by_nature);
    unite(technique.settings, lighting.settings);
    return technique;
}

} // namespace shadowproof
