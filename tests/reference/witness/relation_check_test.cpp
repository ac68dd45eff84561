#include "reference/witness/relation_check.h"
#include "scenes/load/catalog.h"
#include "scenes/relations/relation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace shadowproof {
namespace {

Scene loaded(std::string_view name, int width = 40, int height = 30) {
    SceneRequest request;
    request.width = width;
    request.height = height;
    return load_scene(std::string(name), request);
}

TEST(RelationCheck, the_truth_of_every_bundled_scene_stays_the_same_however_the_scene_is_told) {
    std::vector<std::string> tried;
    for (const BundledScene& bundled : bundled_scenes()) {
        const Scene scene = loaded(bundled.name);
        const RelationCheck check = check_relations(scene, trace(Tracer(scene)), 0);
        EXPECT_EQ(check.changed, 0U) << bundled.name << ": " << words_of(check);
        EXPECT_GE(check.tried.size(), 5U) << bundled.name;
        EXPECT_EQ(check.tried.size() + check.left_out.size(), relations().size() + 1);
        tried.insert(tried.end(), check.tried.begin(), check.tried.end());
    }
    for (const Relation& relation : relations())
        EXPECT_GE(std::ranges::count(tried, relation.name), 5) << relation.name;
    EXPECT_GE(std::ranges::count(tried, "exchanged"), 5);
}

TEST(RelationCheck, a_truth_that_is_wrong_at_one_pixel_is_told_by_every_relation) {
    const Scene scene = loaded("ordinary");
    GroundTruth truth = trace(Tracer(scene));
    Visibility& there = truth.visibility.at(17, 21);
    there = there == Visibility::lit ? Visibility::shadowed : Visibility::lit;
    const RelationCheck check = check_relations(scene, truth, 0);
    EXPECT_EQ(check.changed, check.tried.size() - 1); // all but the exchange, which traces anew
    EXPECT_NE(words_of(check).find("(17,21)"), std::string::npos) << words_of(check);
}

TEST(RelationCheck, points_that_change_places_see_each_other_or_do_not) {
    std::mt19937_64 random(17);
    const auto coordinate = [&](double reach) {
        return static_cast<float>(reach * (static_cast<double>(random() >> 11U) * 0x1p-52 - 1));
    };
    int seen = 0;
    int hidden = 0;
    for (const char* name : {"ordinary", "near_plane", "overlapping", "light_in_plane"}) {
        const Scene scene = loaded(name);
        for (int i = 0; i < 40; ++i) {
            // Half of them vertices, where all that is decided is a tie.
            const auto point = [&] {
                return i % 2 == 0 ? glm::vec3(coordinate(4), coordinate(4), coordinate(4))
                                  : scene.positions[random() % scene.positions.size()];
            };
            const glm::vec3 a = point();
            const glm::vec3 b = point();
            const auto both = mutual_visibility(scene, a, b);
            if (!both) continue;
            EXPECT_EQ((*both)[0], (*both)[1]) << name << " number " << i;
            ++((*both)[0] ? seen : hidden);
        }
    }
    EXPECT_GT(seen, 20);
    EXPECT_GT(hidden, 20);
}

TEST(RelationCheck, a_wall_between_two_points_hides_each_from_the_other) {
    Scene scene = loaded("ordinary");
    scene.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    scene.triangles = {{0, 1, 2}};
    scene.meshes = {{.name = "wall", .triangle_count = 1}};
    using Both = std::array<bool, 2>;
    EXPECT_EQ(mutual_visibility(scene, {0, 0, 2}, {0, 0, -3}), (Both{false, false}));
    EXPECT_EQ(mutual_visibility(scene, {0, 0, 2}, {0.5F, 0, 1}), (Both{true, true}));
    EXPECT_EQ(mutual_visibility(scene, {3, 0, 2}, {3, 0, -3}), (Both{true, true}));
    EXPECT_EQ(mutual_visibility(scene, {0, -1, 2}, {0, -1, -3}), (Both{false, false}))
        << "an edge belongs to its triangle";
    EXPECT_EQ(mutual_visibility(scene, {-3, 0, 0}, {3, 0, 0}), (Both{true, true}))
        << "a triangle in whose plane they lie hides nothing";
    EXPECT_FALSE(mutual_visibility(scene, {1, 2, 3}, {1, 2, 3}));
    scene.meshes[0].casts = false;
    EXPECT_EQ(mutual_visibility(scene, {0, 0, 2}, {0, 0, -3}), (Both{true, true}));
}

} // namespace
} // namespace shadowproof
