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
            EXPECT_EQ(stored->depths->at_surface.pixels, depths.at_surface.pixels);
            EXPECT_EQ(stored->depths->at_infinity.pixels, depths.at_infinity.pixels);
            const ShadowDepths ideal = anew.ideal_depths(traced.truth, traced.depths);
            EXPECT_EQ(stored->ideal_depths->at_surface.pixels, ideal.at_surface.pixels);
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

TEST(VolumeStore, keeps_a_few_alone) {
    const Traced traced("light_inside");
    std::weak_ptr<const CountedVolumes> first = traced.volumes.counted({.extrusion = 1});
    for (const double extrusion : {2.0, 3.0}) traced.volumes.counted({.extrusion = extrusion});
    EXPECT_FALSE(first.expired());
    traced.volumes.counted({.extrusion = 4});
    EXPECT_TRUE(first.expired());
}

} // namespace
} // namespace shadowproof
