#include "tests/odd_geometry/tried.h"

#include "compare/verdict.h"
#include "reference/witness/witness.h"
#include "scenes/error.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>
#include <utility>

namespace shadowproof::tests {

Seeds seeds_to_try(std::uint64_t count) {
    Seeds seeds;
    seeds.count = count;
    if (const char* given = std::getenv("SHADOWPROOF_SEEDS"); given != nullptr)
        seeds.by_hand = bool(std::istringstream(given) >> seeds.first >> seeds.count);
    return seeds;
}

bool names_its_thing(const std::string& message) {
    const auto says = [&](const char* words) { return message.find(words) != std::string::npos; };
    return (says("vertex") && says("mesh \"")) || says("the camera") || says("the light");
}

void check_against_witness(const TracedScene& traced, Dice& dice) {
    const witness::Witness witness(traced.scene);
    const Camera& camera = traced.scene.camera;
    for (int i = 0; i < 4; ++i) {
        const int x = static_cast<int>(dice.below(static_cast<std::uint64_t>(camera.width)));
        const int y = static_cast<int>(dice.below(static_cast<std::uint64_t>(camera.height)));
        const witness::Answer expected = witness.look(line_of_sight(camera, x + 0.5, y + 0.5));
        EXPECT_EQ(traced.truth.triangle.at(x, y), expected.triangle) << "at " << x << ", " << y;
        EXPECT_EQ(traced.truth.visibility.at(x, y), expected.visibility) << "at " << x << ", " << y;
    }
}

namespace {

std::string words_of(const Comparison& comparison) {
    std::string words;
    for (const CauseWords& cause : all_causes)
        if (const std::uint64_t pixels = pixels_of(comparison, cause.cause); pixels > 0)
            words += fmt::format(" {} {}", pixels, cause.name);
    if (comparison.evidence.unexplained > 0)
        words += fmt::format(", {} counters unexplained, first at ({},{})",
                             comparison.evidence.unexplained, comparison.evidence.first_x,
                             comparison.evidence.first_y);
    for (const std::string& clause : comparison.summary.unexplained) words += " " + clause;
    if (comparison.first)
        words += fmt::format(", first at ({},{})", comparison.first->x, comparison.first->y);
    return words;
}

} // namespace

void try_technique(const Technique& technique, const TracedScene& traced, Gpu& gpu) {
    SCOPED_TRACE(technique.name);
    try {
        const Comparison comparison = compared(traced, technique, gpu);
        const Verdict verdict =
            judge(traced.scene, technique.fails_at, technique.by_nature, comparison);
        EXPECT_TRUE(verdict == Verdict::agrees || verdict == Verdict::fails_as_predicted)
            << "FAULT " << technique.name << " " << name_of(verdict) << ":" << words_of(comparison);
    } catch (const Error& error) {
        ADD_FAILURE() << "FAULT " << technique.name << " refused: " << error.what();
    }
}

void try_techniques(const TracedScene& traced, Gpu& gpu) {
    for (const Technique& technique : all_techniques()) {
        if (!suits(technique, traced.scene)) continue;
        if (technique.name == "cube_map_geometry_shader")
            continue; // its maps are those of six passes
        try_technique(technique, traced, gpu);
    }
}

bool is_caught(const TracedScene& traced, Frame frame, const Pixel& at, std::uint32_t counter) {
    frame.counted->counter.at(at.x, at.y) = counter;
    return compared(traced, frame).evidence_miss.at(at.x, at.y) == 1;
}

} // namespace shadowproof::tests
