// Blocks of texels that reach beyond a face of a cube map: the texels of the adjacent face, or the
// border of their own, which is the cause `seam`.
#include "compare/evidence.h"
#include "compare/maps/lookup.h"
#include "compare/verdict.h"
#include "scenes/cube_map.h"
#include "tests/compare/maps/drawn_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof {
namespace {

using tests::compared;
using tests::drawn;
using tests::load_named;
using tests::pixels_of;
using tests::small;
using tests::TracedScene;

/// The middle of a texel on the cube whose faces are 1 away.
glm::dvec3 place_of(const Texel& texel, int size) {
    return through(texel.face, (2.0 * texel.x + 1) / size - 1, 1 - (2.0 * texel.y + 1) / size);
}

/// Texels beside each edge of a face, that many beyond it, at a place along it.
std::array<Texel, 4> beside(std::uint32_t face, int size, int beyond, int along) {
    return {Texel{face, -1 - beyond, along}, Texel{face, size + beyond, along},
            Texel{face, along, -1 - beyond}, Texel{face, along, size + beyond}};
}

TEST(CubeEdges, have_beyond_them_the_texel_as_far_from_them_on_the_adjacent_face) {
    constexpr int size = 8;
    const MapModel model{
        .shape = MapModel::Shape::cube, .size = size, .filter = 4, .edges = MapEdges::seamless};
    for (std::uint32_t face = 0; face < 6; ++face)
        for (int beyond = 0; beyond < size; ++beyond)
            for (int along = 0; along < size; ++along)
                for (const Texel& outside : beside(face, size, beyond, along)) {
                    const Texel found = texel_of_block(model, outside);
                    ASSERT_NE(found.face, face);
                    ASSERT_NE(found.face, face ^ 1U);
                    // Its mirror image lies as far from the edge on this side of it.
                    Texel image = outside;
                    if (image.x < 0) image.x = beyond;
                    if (image.x >= size) image.x = size - 1 - beyond;
                    if (image.y < 0) image.y = beyond;
                    if (image.y >= size) image.y = size - 1 - beyond;
                    const double from_edge = (2.0 * beyond + 1) / size;
                    EXPECT_NEAR(glm::distance(place_of(found, size), place_of(image, size)),
                                std::sqrt(2.0) * from_edge, 1e-12)
                        << face << " " << outside.x << " " << outside.y;
                }
}

TEST(CubeEdges, lead_back_from_the_adjacent_face) {
    constexpr int size = 5;
    const MapModel model{
        .shape = MapModel::Shape::cube, .size = size, .filter = 4, .edges = MapEdges::seamless};
    for (std::uint32_t face = 0; face < 6; ++face)
        for (int along = 0; along < size; ++along)
            for (const Texel& outside : beside(face, size, 0, along)) {
                const Texel adjacent = texel_of_block(model, outside);
                const Texel border{face, std::clamp(outside.x, 0, size - 1),
                                   std::clamp(outside.y, 0, size - 1)};
                int leading_back = 0;
                for (const Texel& beyond : beside(adjacent.face, size, 0, 0))
                    for (int k = 0; k < size; ++k) {
                        Texel tried = beyond;
                        (tried.x == 0 ? tried.x : tried.y) = k;
                        const bool is_beside_it =
                            std::abs(tried.x - adjacent.x) + std::abs(tried.y - adjacent.y) == 1;
                        if (is_beside_it && texel_of_block(model, tried) == border) ++leading_back;
                    }
                EXPECT_EQ(leading_back, 1) << face << " " << outside.x << " " << outside.y;
            }
}

TEST(CubeEdges, have_beyond_two_of_them_the_outermost_row_and_inside_the_texel_itself) {
    const MapModel seamless{.size = 8, .filter = 4, .edges = MapEdges::seamless};
    for (std::uint32_t face = 0; face < 6; ++face) {
        EXPECT_EQ(texel_of_block(seamless, {face, -2, -3}),
                  texel_of_block(seamless, {face, -2, 0}));
        EXPECT_EQ(texel_of_block(seamless, {face, 3, 7}), (Texel{face, 3, 7}));
    }
    MapModel clamped = seamless;
    clamped.edges = MapEdges::clamped;
    EXPECT_EQ(texel_of_block(clamped, {2, -2, 11}), (Texel{2, 0, 7}));
}

class FilteredCube : public testing::Test {
protected:
    Gpu gpu{GlPlatform::osmesa};
    TracedScene scene{small("cube_edge", 256)};

    Frame filtered(MapEdges edges, MapAverage average = MapAverage::comparisons, int filter = 4) {
        return drawn(
            gpu, scene, "cube_map_pcf",
            {.size = 64, .bias = 0.05, .filter = filter, .average = average, .edges = edges});
    }
};

TEST_F(FilteredCube, of_values_fails_by_seams_where_its_border_is_repeated_and_only_there) {
    const Comparison clamped = compared(scene, filtered(MapEdges::clamped, MapAverage::values));
    EXPECT_TRUE(is_explained(clamped));
    EXPECT_GT(pixels_of(clamped, Cause::seam), 0U);
    const Comparison seamless = compared(scene, filtered(MapEdges::seamless, MapAverage::values));
    EXPECT_TRUE(is_explained(seamless));
    EXPECT_EQ(pixels_of(seamless, Cause::seam), 0U);
}

/// What is repeated is in the block anyway: where it says both, so does the block that continues.
TEST_F(FilteredCube, of_comparisons_has_other_shares_at_seams_but_no_other_pixel_wrong) {
    const Frame clamped = filtered(MapEdges::clamped);
    const Frame seamless = filtered(MapEdges::seamless);
    int others = 0;
    for (std::size_t i = 0; i < clamped.claim.pixels.size(); ++i) {
        if (clamped.claim.pixels[i] == Visibility::partly_lit) {
            EXPECT_EQ(seamless.claim.pixels[i], Visibility::partly_lit);
            others += clamped.share.pixels[i] != seamless.share.pixels[i] ? 1 : 0;
        }
    }
    EXPECT_GT(others, 0);
    const Comparison comparison = compared(scene, clamped);
    EXPECT_TRUE(is_explained(comparison));
    EXPECT_EQ(pixels_of(comparison, Cause::seam), 0U);
    EXPECT_TRUE(is_explained(compared(scene, seamless)));
}

TEST_F(FilteredCube, of_one_texel_is_the_map_without_a_filter) {
    const Frame one = filtered(MapEdges::clamped, MapAverage::comparisons, 1);
    EXPECT_EQ(one.claim.pixels,
              drawn(gpu, scene, "cube_map_six_pass", {.size = 64, .bias = 0.05}).claim.pixels);
    EXPECT_EQ(one.claim.pixels,
              filtered(MapEdges::seamless, MapAverage::comparisons, 1).claim.pixels);
}

TEST_F(FilteredCube, whose_edges_are_others_than_it_says_is_caught) {
    for (const MapEdges edges : all_map_edges) {
        Frame frame = filtered(edges);
        EXPECT_TRUE(is_explained(compared(scene, frame)));
        frame.mapped->model.edges =
            edges == MapEdges::clamped ? MapEdges::seamless : MapEdges::clamped;
        EXPECT_FALSE(is_explained(compared(scene, frame))) << name_of(edges);
    }
}

} // namespace
} // namespace shadowproof
