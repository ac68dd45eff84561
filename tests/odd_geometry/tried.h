// Scenes that are tried by all techniques: each is to be explained to the last pixel.
#pragma once

#include "tests/compare/traced_scene.h"
#include "tests/dice.h"
#include "tests/raster/small_scenes.h"

#include <cstdint>
#include <string>

namespace shadowproof::tests {

struct Seeds {
    std::uint64_t first = 1;
    std::uint64_t count = 0;
    bool by_hand = false; ///< then each is said as it is tried
};

/// From 1, or those that SHADOWPROOF_SEEDS="FIRST COUNT" asks for.
Seeds seeds_to_try(std::uint64_t count);

/// Whether a refusal says what it is about.
bool names_its_thing(const std::string& message);

/// A few pixels against brute force over rationals, which takes no size of number for special.
void check_against_witness(const TracedScene& traced, Dice& dice);

/// Expects that the technique agrees or fails as predicted.
void try_technique(const Technique& technique, const TracedScene& traced, Gpu& gpu);
void try_techniques(const TracedScene& traced, Gpu& gpu);

/// Whether another counter at a pixel than what the technique drew is caught there.
bool is_caught(const TracedScene& traced, Frame frame, const Pixel& at, std::uint32_t counter);

} // namespace shadowproof::tests
