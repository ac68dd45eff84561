#include "raster/joined.h"

#include <fmt/format.h>

#include <algorithm>

namespace shadowproof {

namespace {

template <class T>
void unite(std::vector<T>& all, const std::vector<T>& more) {
    for (const T& each : more)
        if (std::ranges::find(all, each) == all.end()) all.push_back(each);
}

} // namespace

Joined::Joined(const Technique& lighting, const Technique& shadowing, double cost)
    : name_(fmt::format("{}+{}", lighting.name, shadowing.name)),
      summary_(fmt::format("{}, and bumps lit as by {}", shadowing.name, lighting.name)),
      source_(fmt::format("{}; {}", lighting.source, shadowing.source)),
      needs_(fmt::format("{}; {}", shadowing.needs, lighting.needs)), technique_(shadowing) {
    technique_.name = name_;
    technique_.summary = summary_;
    technique_.source = source_;
    technique_.needs = needs_;
    technique_.cost = cost;
    technique_.needs_bump_maps = lighting.needs_bump_maps;
    technique_.needs_environment = lighting.needs_environment;
    technique_.filters_bumps = lighting.filters_bumps;
    technique_.sees_in_parallel = lighting.sees_in_parallel && shadowing.sees_in_parallel;
    technique_.squares_thrice = lighting.squares_thrice;
    technique_.lighting = lighting.lighting;
    // What lighting fails at itself; the rest is what it finds its own shadows by.
    unite(technique_.fails_at, lighting.by_nature);
    unite(technique_.by_nature, lighting.by_nature);
    unite(technique_.settings, lighting.settings);
}

} // namespace shadowproof
