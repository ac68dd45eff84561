#include "compare/judge/pixel_record.h"
#include "compare/stencil/ledger_table.h"
#include "raster/render.h"
#include "raster/technique.h"
#include "reference/predict/pixel_ledger.h"
#include "reference/predict/tally.h"
#include "scenes/error.h"
#include "scenes/load/catalog.h"
#include "scenes/plan/plan.h"
#include "tests/compare/traced_scene.h"

#include <gtest/gtest.h>

#include <string>

namespace shadowproof {
namespace {

/// One cell with its table, and what the table was made from.
struct TabledCell {
    tests::TracedScene traced;
    Frame frame;
    std::optional<Prediction> prediction;
    Comparison comparison;
    LedgerTable table;

    TabledCell(const std::string& name, const std::string& technique, int threads = 0)
        : traced(load_scene(name, {}), threads) {
        Gpu gpu(GlPlatform::osmesa);
        frame = render(*find_technique(technique), traced.scene, traced.plan, gpu);
        prediction.emplace(prediction_of(traced, frame));
        comparison = compared(traced, frame);
        table = list_ledgers(traced.tracer, traced.truth, frame, *prediction, comparison.cause,
                             MemoryBudget{});
    }

    /// Calls visit(i, x, y) for every differing pixel, in rows from the top.
    template <class Visit>
    void for_differing(const Visit& visit) const {
        std::size_t i = 0;
        for (int y = 0; y < traced.scene.camera.height; ++y)
            for (int x = 0; x < traced.scene.camera.width; ++x)
                if (comparison.cause.at(x, y) != no_difference) visit(i++, x, y);
    }
};

class LedgerTableTest : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(LedgerTableTest, what_was_counted_adds_up_to_the_prediction_at_every_differing_pixel) {
    const TabledCell cell(GetParam().first, GetParam().second);
    const LedgerTable& table = cell.table;
    const Counting& counting = cell.frame.counted->counting;
    const bool caps_counted =
        tally_of_dark_caps(counting, cell.frame.depth_model) == Tally::counted;
    cell.for_differing([&](std::size_t i, int x, int y) {
        const std::uint32_t ledger = table.ledger[i];
        ASSERT_EQ(table.adds_up[ledger], 1) << x << ", " << y;
        std::int64_t count = caps_counted ? table.counts[counts_of_ledger * ledger + 4] : 0;
        for (std::uint32_t k = table.start[ledger]; k < table.start[ledger + 1]; ++k)
            if (table.crossing_tally[k] == static_cast<std::uint8_t>(Tally::counted))
                count += weight(counting.test) * table.crossing_change[k];
        ASSERT_EQ(count, cell.prediction->counts().at(x, y)) << x << ", " << y;
    });
}

TEST_P(LedgerTableTest, the_table_holds_what_the_pixels_alone_say) {
    const TabledCell cell(GetParam().first, GetParam().second);
    const LedgerTable& table = cell.table;
    ASSERT_EQ(table.ledger.size(), cell.comparison.differing);
    cell.for_differing([&](std::size_t i, int x, int y) {
        if (i % 997 != 0) return;
        const PixelRecord record = record_pixel(cell.traced.traced, x, y);
        EXPECT_EQ(table.shown[i], cell.frame.triangle.at(x, y));
        const std::uint32_t ledger = table.ledger[i];
        const RayCounts& counts = record.ledger.counts;
        const auto own =
            table.counts.begin() + static_cast<std::ptrdiff_t>(counts_of_ledger * ledger);
        const std::vector<std::int32_t> listed(own, own + counts_of_ledger);
        EXPECT_EQ(listed, (std::vector<std::int32_t>{counts.at_eye, counts.at_near,
                                                     counts.at_surface, counts.at_far,
                                                     counts.at_infinity, record.let_through}));
        const std::uint32_t first = table.start[ledger];
        ASSERT_EQ(table.start[ledger + 1] - first, record.ledger.crossings.size());
        for (std::size_t k = 0; k < record.ledger.crossings.size(); ++k) {
            const Crossing& crossing = record.ledger.crossings[k];
            const std::uint32_t face = table.crossing_face[first + k];
            EXPECT_EQ(table.face[2 * face], crossing.triangle) << x << ", " << y;
            EXPECT_EQ(table.face[2 * face + 1], static_cast<std::uint32_t>(crossing.part));
            EXPECT_EQ(table.crossing_change[first + k], crossing.change);
            EXPECT_EQ(table.crossing_tally[first + k],
                      static_cast<std::uint8_t>(tally(crossing, record.ledger.surface, record.seen,
                                                      record.far, cell.frame.counted->counting,
                                                      cell.frame.depth_model)));
        }
    });
}

TEST_P(LedgerTableTest, the_table_is_the_same_for_any_number_of_threads) {
    const LedgerTable one = TabledCell(GetParam().first, GetParam().second, 1).table;
    const LedgerTable five = TabledCell(GetParam().first, GetParam().second, 5).table;
    EXPECT_EQ(one.ledger, five.ledger);
    EXPECT_EQ(one.crossing_face, five.crossing_face);
    EXPECT_EQ(one.crossing_tally, five.crossing_tally);
    EXPECT_EQ(one.triangle, five.triangle);
    EXPECT_EQ(one.vertex, five.vertex);
}

INSTANTIATE_TEST_SUITE_P(
    Cells, LedgerTableTest,
    testing::Values(std::pair("near_plane", "zpass"), std::pair("eye_inside", "zpass"),
                    std::pair("far_plane", "zfail"), std::pair("ordinary", "zfail_infinite"),
                    std::pair("perforated", "zfail_reversed")),
    [](const auto& cell) { return std::string(cell.param.first) + "_" + cell.param.second; });

TEST(LedgerTable, what_does_not_fit_is_refused_with_the_pixels_that_it_is_for) {
    const TabledCell cell("near_plane", "zpass");
    const auto within = [&](std::uint64_t bytes) {
        return list_ledgers(cell.traced.tracer, cell.traced.truth, cell.frame, *cell.prediction,
                            cell.comparison.cause, {program_bytes + bytes, "--memory"});
    };
    // What the lists hold, without what they hold in reserve.
    const std::uint64_t pixels = 8 * cell.table.ledger.size();
    const std::uint64_t crossings = 6 * cell.table.crossing_face.size();
    EXPECT_EQ(within(8 * (pixels + crossings) + 1'000'000).ledger, cell.table.ledger);
    try {
        within(pixels + crossings);
        FAIL() << "it fits into less than its lists";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("what rays cross at"), std::string::npos)
            << error.what();
        EXPECT_NE(std::string(error.what()).find("--memory"), std::string::npos);
    }
}

TEST(LedgerTable, a_cell_without_a_difference_has_an_empty_table) {
    const Scene scene =
        load_scene("ordinary", {.camera = {}, .light = {}, .time = 0, .width = 32, .height = 32});
    const Tracer tracer(scene);
    const GroundTruth truth = trace(tracer);
    const ShadowDepths depths = count_shadow_depths(tracer, truth, finite_far(scene));
    const Silhouette silhouette(tracer);
    const VolumeStore volumes(tracer, silhouette, truth, depths);
    const Prediction prediction(volumes, {}, {});
    Frame counted;
    counted.counted.emplace();
    const LedgerTable table = list_ledgers(tracer, truth, counted, prediction,
                                           Image<std::uint8_t>(32, 32, no_difference), {});
    EXPECT_TRUE(table.ledger.empty());
    EXPECT_TRUE(table.vertex.empty());
    EXPECT_EQ(table.start, std::vector<std::uint32_t>{0});
}

TEST(PixelRecord, margins_are_the_distances_to_the_nearest_face_and_class) {
    const Scene scene = load_scene("near_plane", {});
    const Tracer tracer(scene);
    const GroundTruth truth = trace(tracer);
    const TracedScene traced(tracer, truth);
    for (const auto& [x, y] : {std::pair(229, 103), std::pair(0, 0), std::pair(511, 511),
                               std::pair(300, 250), std::pair(130, 136)}) {
        double nearest = 1e9;
        for (int i = 0; i < 512; ++i)
            for (int k = 0; k < 512; ++k)
                if (truth.visibility.at(i, k) != truth.visibility.at(x, y))
                    nearest = std::min(nearest, std::hypot(i - x, k - y));
        const PixelRecord record = record_pixel(traced, x, y);
        ASSERT_TRUE(record.pixel_margin);
        EXPECT_DOUBLE_EQ(*record.pixel_margin, nearest) << x << ", " << y;
        EXPECT_TRUE(record.seen != no_triangle || !record.depth_margin);
    }
}

} // namespace
} // namespace shadowproof
