#include "scenes/load/catalog.h"
#include "scenes/load/digest.h"

#include <gtest/gtest.h>

namespace shadowproof {
namespace {

TEST(Digest, the_same_file_has_the_same_digest_and_every_content_counts) {
    const Scene scene = load_scene("ordinary", {});
    const std::string digest = digest_of(scene);
    EXPECT_EQ(digest.size(), 16U);
    EXPECT_EQ(digest, digest_of(load_scene("ordinary", {})));

    const auto changed = [&](auto change) {
        Scene other = scene;
        change(other);
        return digest_of(other) != digest;
    };
    EXPECT_TRUE(changed([](Scene& s) { s.positions[7].y += 0x1p-20F; }));
    EXPECT_TRUE(changed([](Scene& s) { std::swap(s.triangles[0].x, s.triangles[0].y); }));
    EXPECT_TRUE(changed([](Scene& s) { s.camera.near *= 2; }));
    EXPECT_TRUE(changed([](Scene& s) { ++s.camera.width; }));
    EXPECT_TRUE(changed([](Scene& s) { s.lights[s.light].position.x += 1; }));
    EXPECT_TRUE(changed([](Scene& s) { s.materials[s.meshes[0].material].double_sided ^= true; }));
    EXPECT_TRUE(changed([](Scene& s) { s.meshes[0].casts = false; }));
    EXPECT_TRUE(changed([](Scene& s) { s.meshes[0].receives = false; }));
    EXPECT_FALSE(changed([](Scene& s) { s.lights[s.light].outer_cone /= 2; }));
    EXPECT_TRUE(changed([](Scene& s) { s.lights[s.light].kind = Light::Kind::directional; }));
    EXPECT_FALSE(changed([](Scene& s) { s.name = "other"; }));
}

TEST(Digest, a_sun_counts_by_its_direction_and_a_spot_by_its_cone) {
    Scene scene = load_scene("ordinary", {});
    Light& light = scene.lights[scene.light];
    const auto changes = [&](auto change) {
        const std::string before = digest_of(scene);
        change();
        return digest_of(scene) != before;
    };
    light.kind = Light::Kind::directional;
    EXPECT_FALSE(changes([&] { light.position.x += 1; }));
    EXPECT_TRUE(changes([&] { light.direction.x += 0x1p-50; }));
    light.kind = Light::Kind::spot;
    EXPECT_TRUE(changes([&] { light.position.x += 1; }));
    EXPECT_TRUE(changes([&] { light.direction.y += 0x1p-50; }));
    EXPECT_TRUE(changes([&] { light.outer_cone /= 2; }));
}

TEST(Digest, counts_what_lighting_needs_in_scenes_with_bump_maps_alone) {
    const auto changes = [](const char* name, auto change) {
        Scene scene = load_scene(name, {});
        const std::string before = digest_of(scene);
        change(scene);
        return digest_of(scene) != before;
    };
    for (const char* name : {"ordinary", "bumpy_torus"}) {
        const bool counts = std::string(name) == "bumpy_torus";
        EXPECT_EQ(changes(name, [](Scene& s) { s.ambient.y += 0x1p-30; }), counts);
        EXPECT_EQ(changes(name, [](Scene& s) { s.materials[1].specular.x /= 2; }), counts);
        EXPECT_EQ(changes(name, [](Scene& s) { s.lights[0].color.z /= 2; }), counts);
    }
    EXPECT_TRUE(changes("hammered_silver", [](Scene& s) { s.materials[1].reflectance.x /= 2; }));
    EXPECT_TRUE(
        changes("hammered_silver", [](Scene& s) { (*s.environment)[2].at(3, 5).g += 0.01F; }));
    EXPECT_TRUE(changes("hammered_silver", [](Scene& s) { s.environment.reset(); }));
    EXPECT_TRUE(changes("bumpy_torus", [](Scene& s) { s.surfaces[77].tangent.w *= -1; }));
    EXPECT_TRUE(changes("bumpy_torus", [](Scene& s) { s.textures[0].texels.at(3, 5).g += 0.01F; }));
    EXPECT_TRUE(
        changes("bumpy_torus", [](Scene& s) { s.textures[1].wrap_t = Wrap::clamp_to_edge; }));
}

} // namespace
} // namespace shadowproof
