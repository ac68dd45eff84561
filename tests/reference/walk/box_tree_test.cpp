// Rays reach every cluster that they meet, with each instruction set, however far away they begin
// and however little of them is known.
#include "reference/trace/trace.h"
#include "reference/walk/box_trees.h"
#include "reference/walk/instruction_set.h"
#include "reference/walk/walk_lines.h"
#include "scenes/error.h"
#include "tests/dice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <new>
#include <string>
#include <vector>

namespace shadowproof {
namespace {

TEST(Embree, another_version_than_the_one_that_was_looked_into_is_told) {
    EXPECT_FALSE(note_on_embree("3.13.5"));
    EXPECT_EQ(note_on_embree("3.13.6"),
              "Embree 3.13.6 finds what rays may meet; that it loses nothing was shown of 3.13.5");
}

enum class Query : std::uint8_t { nearest, any, all };

struct Sent {
    std::string instruction_set;
    Query query;
};
std::ostream& operator<<(std::ostream& out, const Sent& sent) {
    return out << sent.instruction_set << static_cast<int>(sent.query);
}

/// Small triangles here and there, each far from the others.
Scene scattered(Dice& dice) {
    Scene scene;
    for (int i = 0; i < 600; ++i) {
        const auto coordinate = [&] { return static_cast<float>(dice.between(-3, 5)); };
        const glm::vec3 middle(coordinate(), coordinate(), coordinate());
        const auto first = static_cast<std::uint32_t>(scene.positions.size());
        for (int k = 0; k < 3; ++k)
            scene.positions.push_back(
                middle + 0.01F * glm::vec3(glm::dvec3(dice.between(-1, 1), dice.between(-1, 1),
                                                      dice.between(-1, 1))));
        scene.triangles.emplace_back(first, first + 1, first + 2);
    }
    return scene;
}

std::vector<std::uint32_t> numbers(std::size_t count) {
    std::vector<std::uint32_t> all(count);
    for (std::size_t i = 0; i < count; ++i) all[i] = static_cast<std::uint32_t>(i);
    return all;
}

class BoxTreeTest : public testing::TestWithParam<Sent> {
protected:
    Dice dice_{20261127};
    Scene scene_ = scattered(dice_);
    std::vector<std::uint32_t> triangles_ = numbers(scene_.triangles.size());
    Clusters clusters_;

    void SetUp() override {
        setenv("SHADOWPROOF_INSTRUCTION_SET", GetParam().instruction_set.c_str(), 1);
        try {
            choose_instruction_set();
        } catch (const Error& error) {
            ASSERT_NE(GetParam().instruction_set, "sse2") << error.what();
            GTEST_SKIP() << error.what();
        }
        clusters_ = build_clusters(scene_, triangles_, triangles_, 1);
    }
    void TearDown() override {
        unsetenv("SHADOWPROOF_INSTRUCTION_SET");
        choose_instruction_set();
    }

    /// Whether the query's visits include this cluster for this lane.
    struct Visits {
        std::array<std::vector<std::uint32_t>, packet_size> of_lane;
        static void visit(void* visitor, std::uint32_t cluster, int first, int count, float*) {
            auto& visits = *static_cast<Visits*>(visitor);
            for (int i = first; i < first + count; ++i)
                visits.of_lane[static_cast<std::size_t>(i)].push_back(cluster);
        }
    };

    static glm::dvec3 in_frame(const WalkFrame& frame, const glm::vec3& p) {
        return (glm::dvec3(p) - frame.center) * frame.scale;
    }

    double component() {
        const double sign = dice_.one_in(2) ? 1 : -1;
        switch (dice_.below(6)) {
        case 0:
            return sign * 0.0;
        case 1:
            return sign * 1e-18 * dice_.between(0.5, 1.5);
        case 2:
            return sign * std::exp2(-60 * dice_.between(0, 1));
        default:
            return sign * dice_.between(0, 1.99);
        }
    }

    /// How many of so many packets' rays do not reach the corner of a box that their true line
    /// meets, where that is `off` aside from the given one, on every axis. One ray in a packet, so
    /// that no other's visit hides what is lost, and sixteen together by turns.
    int lost_of(int packets, const BoxTree& tree, const WalkFrame& frame, double off) {
        int lost = 0;
        for (int packet = 0; packet < packets; ++packet) {
            WalkLines lines;
            WalkRays rays;
            Lanes<double> start{};
            std::array<std::uint32_t, packet_size> met{};
            rays.lanes = packet % 2 == 0 ? 1U << dice_.below(packet_size) : 0xffffU;
            for (std::size_t lane = 0; lane < packet_size; ++lane) {
                met[lane] = static_cast<std::uint32_t>(dice_.below(clusters_.all.size()));
                const Box& box = clusters_.boxes[met[lane]];
                const glm::dvec3 lower = in_frame(frame, box.lower);
                const glm::dvec3 upper = in_frame(frame, box.upper);
                glm::dvec3 w(component(), component(), component());
                w[static_cast<int>(dice_.below(3))] =
                    (dice_.one_in(2) ? 1 : -1) * dice_.between(1, 1.99);
                // Far away, or within the box.
                const double s =
                    dice_.one_in(2) ? dice_.between(0, 2) : std::exp2(dice_.between(0, 20));
                glm::dvec3 p;
                for (int axis = 0; axis < 3; ++axis) {
                    const bool at_lower = dice_.one_in(2);
                    const double aside = (at_lower ? -1 : 1) * off;
                    p[axis] = (at_lower ? lower : upper)[axis] + aside - s * w[axis];
                }
                lines.p.set(lane, p);
                lines.w.set(lane, w);
                lines.begin[lane] = dice_.one_in(2) ? 0 : s * (1 - 0x1p-30) - 0x1p-30;
                lines.end[lane] = dice_.one_in(2) ? std::numeric_limits<double>::infinity()
                                                  : s * (1 + 0x1p-30) + 0x1p-30;
            }
            cut_to_scene(lines, rays, start);
            Visits visits;
            if (GetParam().query == Query::nearest)
                tree.find_nearest(rays, Visits::visit, &visits);
            else if (GetParam().query == Query::any)
                tree.find_any(rays, Visits::visit, &visits);
            else
                tree.find_all(rays, Visits::visit, &visits);
            for (std::size_t lane = 0; lane < packet_size; ++lane)
                if ((rays.lanes >> lane & 1U) != 0 &&
                    std::ranges::find(visits.of_lane[lane], met[lane]) ==
                        visits.of_lane[lane].end())
                    ++lost;
        }
        return lost;
    }
};

TEST_P(BoxTreeTest, rays_reach_every_box_within_the_room_of_their_true_lines) {
    const BoxTrees trees(clusters_, 1);
    // A ray is given in double: where it begins 2^20 away, it is off by 2^-32.
    for (const double room : {0.0, 0x1p-18, 0x1p-13, 0x1p-8}) {
        const BoxTree* tree = trees.with_room(room);
        ASSERT_NE(tree, nullptr);
        EXPECT_LE(room, tree->room());
        EXPECT_EQ(lost_of(20000, *tree, trees.frame(), tree->room() - 0x1p-30), 0) << room;
    }
    EXPECT_EQ(trees.with_room(0.5), nullptr);
    EXPECT_EQ(trees.with_room(std::numeric_limits<double>::quiet_NaN()), nullptr);
}

TEST_P(BoxTreeTest, further_aside_than_the_margin_boxes_are_lost) {
    const BoxTrees trees(clusters_, 1);
    const BoxTree* tree = trees.with_room(0);
    EXPECT_GT(lost_of(1000, *tree, trees.frame(), 2 * double{tree->margin()}), 100);
}

TEST_P(BoxTreeTest, what_lies_very_far_out_is_reached_by_every_ray) {
    const auto first = static_cast<std::uint32_t>(scene_.positions.size());
    scene_.positions.insert(scene_.positions.end(), {{1e12F, 0, 0}, {1e12F, 1, 0}, {1e12F, 0, 1}});
    scene_.triangles.emplace_back(first, first + 1, first + 2);
    triangles_ = numbers(scene_.triangles.size());
    clusters_ = build_clusters(scene_, triangles_, triangles_, 1);
    std::uint32_t outlying = 0;
    for (std::uint32_t i = 0; i < clusters_.all.size(); ++i)
        if (std::ranges::find(clusters_.all[i].triangles, triangles_.back()) !=
            clusters_.all[i].triangles.end())
            outlying = i;
    const BoxTrees trees(clusters_, 1);
    for (int packet = 0; packet < 500; ++packet) {
        WalkLines lines;
        WalkRays rays;
        rays.lanes = 1U << dice_.below(packet_size);
        for (std::size_t lane = 0; lane < packet_size; ++lane) {
            const auto anywhere = [&] {
                return dice_.between(-1, 1) * std::exp2(dice_.between(0, 9));
            };
            lines.p.set(lane, {anywhere(), anywhere(), anywhere()});
            lines.w.set(lane, {component(), component(), dice_.between(1, 1.99)});
            lines.end[lane] = std::numeric_limits<double>::infinity();
        }
        Lanes<double> start{};
        cut_to_scene(lines, rays, start);
        Visits visits;
        trees.with_room(0)->find_all(rays, Visits::visit, &visits);
        const auto lane = static_cast<std::size_t>(__builtin_ctz(rays.lanes));
        EXPECT_NE(std::ranges::find(visits.of_lane[lane], outlying), visits.of_lane[lane].end());
    }
}

TEST_P(BoxTreeTest, what_a_visit_throws_is_thrown_on) {
    const BoxTrees trees(clusters_, 1);
    WalkLines lines;
    WalkRays rays;
    rays.lanes = 0xffff;
    for (std::size_t lane = 0; lane < packet_size; ++lane) {
        lines.p.set(lane, in_frame(trees.frame(), scene_.positions[0]) - glm::dvec3(3, 0, 0));
        lines.w.set(lane, {1, 0, 0});
        lines.end[lane] = 10;
    }
    Lanes<double> start{};
    cut_to_scene(lines, rays, start);
    int visits = 0;
    const VisitCluster out_of_memory = [](void* count, std::uint32_t, int, int, float*) {
        ++*static_cast<int*>(count);
        throw std::bad_alloc();
    };
    const BoxTree& tree = *trees.with_room(0);
    EXPECT_THROW(tree.find_nearest(rays, out_of_memory, &visits), std::bad_alloc);
    EXPECT_THROW(tree.find_any(rays, out_of_memory, &visits), std::bad_alloc);
    EXPECT_THROW(tree.find_all(rays, out_of_memory, &visits), std::bad_alloc);
    EXPECT_EQ(visits, 3);
}

std::vector<Sent> all_ways() {
    std::vector<Sent> ways;
    for (const char* set : {"sse2", "sse4", "avx2", "avx512"})
        for (const Query query : {Query::nearest, Query::any, Query::all})
            ways.push_back({set, query});
    return ways;
}

std::string name_of(const testing::TestParamInfo<Sent>& way) {
    constexpr std::array names{"nearest", "any", "all"};
    return way.param.instruction_set + "_" + names[static_cast<std::size_t>(way.param.query)];
}

INSTANTIATE_TEST_SUITE_P(Reference, BoxTreeTest, testing::ValuesIn(all_ways()), name_of);

} // namespace
} // namespace shadowproof
