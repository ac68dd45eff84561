#include "reference/parallel.h"
#include "reference/predict/volume_store.h"
#include "scenes/load/catalog.h"
#include "scenes/plan/plan.h"

#include <gtest/gtest.h>

namespace shadowproof {
namespace {

struct Traced {
    Scene scene;
    Tracer tracer;
    Silhouette silhouette;
    GroundTruth truth;
    ShadowDepths depths;
    VolumeStore volumes;

    explicit Traced(const char* name)
        : scene(
              load_scene(name, {.camera = {}, .light = {}, .time = 0, .width = 24, .height = 24})),
          tracer(scene), silhouette(tracer), truth(trace(tracer)),
          depths(count_shadow_depths(tracer, truth, finite_far(scene))),
          volumes(tracer, silhouette, truth, depths) {}
};

/// One of each difference that volumes know.
std::vector<Counting> countings(const Scene& scene) {
    Counting left_out;
    left_out.casters.resize(scene.triangles.size());
    const Mesh& mesh = scene.meshes.front();
    for (std::uint32_t i = 0; i < mesh.triangle_count; ++i)
        left_out.casters[mesh.first_triangle + i].left_out = true;
    return {{},
            {.flips = {.around_light = true}},
            {.flips = {.averted = Counting::Flips::Averted::of_all_shells}},
            {.holes_filled = true},
            {.extrusion = 2},
            {.extrusion = 3},
            left_out};
}

void expect_same(const ShadowDepths& one, const ShadowDepths& other) {
    EXPECT_EQ(one.at_surface.pixels, other.at_surface.pixels);
    EXPECT_EQ(one.at_near.pixels, other.at_near.pixels);
    EXPECT_EQ(one.at_far.pixels, other.at_far.pixels);
    EXPECT_EQ(one.at_infinity.pixels, other.at_infinity.pixels);
    EXPECT_EQ(one.at_eye, other.at_eye);
    EXPECT_EQ(one.far, other.far);
}

TEST(VolumeStore, gives_what_volumes_made_anew_are) {
    for (const char* name : {"light_inside", "open_lid"}) {
        const Traced traced(name);
        // Twice, so that each is asked for after each other one.
        std::vector<Counting> asked = countings(traced.scene);
        const std::vector<Counting> again = asked;
        asked.insert(asked.end(), again.rbegin(), again.rend());
        for (const Counting& counting : asked) {
            const Volumes anew(traced.tracer, traced.silhouette, counting);
            const auto stored = traced.volumes.counted(counting);
            EXPECT_EQ(stored->volumes.casters().triangles, anew.casters().triangles);
            const ShadowDepths depths = anew.shadow_depths(traced.truth, traced.depths);
            expect_same(*stored->depths, depths);
            expect_same(*stored->ideal_depths, anew.ideal_depths(traced.truth, traced.depths));
        }
    }
}

TEST(VolumeStore, makes_them_once_for_techniques_that_count_the_same) {
    const Traced traced("light_inside");
    const Counting behind{.flips = {.around_light = true}};
    Counting in_front = behind; // how faces are counted makes no other volumes
    in_front.test = Counting::Test::depth_pass;
    in_front.dark_cap = false;
    in_front.bits = 24;
    const auto first = traced.volumes.counted(behind);
    EXPECT_EQ(traced.volumes.counted(in_front), first);
    EXPECT_NE(traced.volumes.counted({}), first);
    EXPECT_EQ(traced.volumes.counted(behind), first);
    // The casters' own cost no picture.
    EXPECT_EQ(traced.volumes.counted({})->depths.get(), &traced.depths);
}

TEST(VolumeStore, keeps_one_scene_beside_the_casters) {
    const Traced traced("light_inside");
    const std::weak_ptr<const CountedVolumes> own = traced.volumes.counted({});
    const std::weak_ptr<const CountedVolumes> first = traced.volumes.counted({.extrusion = 1});
    EXPECT_FALSE(first.expired());
    const auto used = traced.volumes.counted({.extrusion = 2});
    EXPECT_TRUE(first.expired());
    traced.volumes.counted({.extrusion = 3});
    EXPECT_EQ(used->depths->far, traced.depths.far); // still there for those that use them
    EXPECT_FALSE(own.expired());
}

TEST(VolumeStore, may_be_asked_by_many_threads) {
    const Traced traced("open_lid");
    const std::vector<Counting> asked = countings(traced.scene);
    std::vector<ShadowDepths> alone;
    for (const Counting& counting : asked)
        alone.push_back(*traced.volumes.counted(counting)->depths);
    parallel_for(4 * static_cast<int>(asked.size()), 4, [&](int i, int) {
        const std::size_t which = static_cast<std::size_t>(i) % asked.size();
        expect_same(*traced.volumes.counted(asked[which])->depths, alone[which]);
    });
}

} // namespace
} // namespace shadowproof
