#include "compare/memory.h"
#include "scenes/error.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <functional>
#include <string>

namespace shadowproof {
namespace {

std::string refusal(const std::function<void()>& ask) {
    try {
        ask();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

constexpr std::array every_workload{Workload::class_map, Workload::truth,     Workload::colors,
                                    Workload::terms,     Workload::lit_truth, Workload::comparison};

TEST(Memory, a_picture_that_just_fits_is_taken_and_one_byte_less_refuses_it) {
    for (const Workload work : every_workload) {
        const std::uint64_t needed = program_bytes + 1000 * pixel_bytes(work, false);
        const auto ask = [&](std::uint64_t bytes) {
            return refusal([&] { require_picture({bytes, "--memory"}, 100, 10, work); });
        };
        EXPECT_EQ(ask(needed), "");
        EXPECT_EQ(ask(needed - 1).find("--size 100x10: needs "), 0U) << ask(needed - 1);
    }
}

TEST(Memory, colours_of_a_lit_scene_count_with_its_picture) {
    EXPECT_GT(pixel_bytes(Workload::comparison, true), pixel_bytes(Workload::comparison, false));
    for (const Workload work : every_workload) {
        Scene scene;
        scene.file = "model.glb";
        scene.camera.width = 100;
        scene.camera.height = 10;
        const auto ask = [&](std::uint64_t bytes) {
            return refusal([&] { require_scene({bytes, "--memory"}, scene, work); });
        };
        const std::uint64_t plain = program_bytes + 1000 * pixel_bytes(work, false);
        EXPECT_EQ(ask(plain), "");
        EXPECT_NE(ask(plain - 1).find("a picture of 100x10"), std::string::npos) << ask(plain - 1);
        scene.surfaces.resize(1);
        const std::uint64_t lit = program_bytes + 1000 * pixel_bytes(work, true);
        EXPECT_NE(ask(lit - 1).find("a picture of 100x10"), std::string::npos) << ask(lit - 1);
        EXPECT_EQ(ask(lit + 4 * sizeof(Surface)), "");
    }
}

TEST(Memory, the_largest_size_that_parses_does_not_overflow) {
    EXPECT_NE(refusal([] {
                  require_picture({1ULL << 33U, "--memory"}, 16384, 16384, Workload::comparison);
              }),
              "");
}

TEST(Memory, a_scene_that_does_not_fit_is_told_by_what_takes_most_of_it) {
    Scene scene;
    scene.file = "model.glb";
    scene.camera.width = scene.camera.height = 10;
    scene.triangles.resize(1000);
    const MemoryBudget budget{program_bytes + 1000, "--memory"};
    const auto ask = [&] {
        return refusal([&] { require_scene(budget, scene, Workload::truth); });
    };
    EXPECT_NE(ask().find("model.glb: needs "), std::string::npos) << ask();
    EXPECT_NE(ask().find("1000 triangles"), std::string::npos) << ask();
    scene.textures.push_back({.name = "map", .texels = Image<glm::vec4>(100, 100)});
    EXPECT_NE(ask().find("10000 texels"), std::string::npos) << ask();
    EXPECT_NE(ask().find("make its textures smaller"), std::string::npos) << ask();
    scene.camera.width = 100000;
    EXPECT_NE(ask().find("a picture of 100000x10"), std::string::npos) << ask();
}

} // namespace
} // namespace shadowproof
