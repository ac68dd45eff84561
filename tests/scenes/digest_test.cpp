#include "scenes/catalog.h"
#include "scenes/digest.h"

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
    EXPECT_FALSE(changed([](Scene& s) { s.name = "other"; }));
}

} // namespace
} // namespace shadowproof
