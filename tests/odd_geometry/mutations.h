// Scenes with odd numbers in them: a few coordinates, vertices, triangles, the eye or the light
// replaced, as a broken exporter, a broken file or an unlucky pose would.
#pragma once

#include "scenes/scene.h"

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace shadowproof::tests {

/// Draws from a generator whose numbers are the same everywhere, which the standard's
/// distributions are not.
class Dice {
public:
    explicit Dice(std::uint64_t seed) : random_(seed) {}

    std::uint64_t below(std::uint64_t count) { return random_() % count; }
    template <class T>
    const T& one_of(const std::vector<T>& all) {
        return all[below(all.size())];
    }
    double between(double low, double high) {
        return low + (high - low) * static_cast<double>(random_() >> 11U) * 0x1p-53;
    }

private:
    std::mt19937_64 random_;
};

/// Small scenes to mutate: closed casters over a floor, and the smallest of the bundled ones.
std::vector<Scene> scenes_to_mutate();

/// Mutates a scene by one to three steps; says in words what was done.
std::vector<std::string> mutate(Scene& scene, Dice& dice);

/// Whether all vertices that are used, the eye, the near plane and the lights are finite.
bool is_finite(const Scene& scene);

} // namespace shadowproof::tests
