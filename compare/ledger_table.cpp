#include "compare/ledger_table.h"

#include "compare/pixel_ledger.h"
#include "reference/parallel.h"
#include "reference/tally.h"

#include <xxhash.h>

#include <algorithm>
#include <span>
#include <unordered_map>

namespace shadowproof {

namespace {

/// Pixels along a region's side: measured, 8 and 32 take a third longer.
constexpr int region_side = 16;

struct Inputs {
    const Tracer& tracer;
    const Silhouette& silhouette;
    const GroundTruth& truth;
    const ShadowDepths& depths;
    const Frame& frame;
    const Image<std::uint8_t>& cause;
};

/// A ledger as numbers, the same for pixels whose ledgers are the same.
using Words = std::vector<std::uint64_t>;

constexpr std::uint64_t crossing_word(const Crossing& crossing, Tally tally) {
    return std::uint64_t{crossing.triangle} << 32U | static_cast<std::uint64_t>(tally) << 8U |
           static_cast<std::uint64_t>(crossing.part) << 1U | (crossing.change > 0 ? 1U : 0U);
}

constexpr std::size_t count_words = 3; ///< before the crossings' words

void append_words(const Inputs& in, const PixelLedger& ledger, std::uint32_t seen, Words& words) {
    const auto pair = [](std::int32_t high, std::int32_t low) {
        return std::uint64_t{static_cast<std::uint32_t>(high)} << 32U |
               static_cast<std::uint32_t>(low);
    };
    const RayCounts& counts = ledger.counts;
    words.push_back(pair(counts.at_near, counts.at_surface));
    words.push_back(pair(counts.at_far, counts.at_infinity));
    words.push_back(pair(counts.at_eye, ledger.adds_up ? 1 : 0));
    for (const Crossing& crossing : ledger.crossings)
        words.push_back(crossing_word(crossing, tally(crossing, ledger.surface, seen, in.depths.far,
                                                      in.frame.counting, in.frame.depth_model)));
}

/// The ledgers of one region's differing pixels, in rows from the top.
struct RegionWords {
    std::vector<std::size_t> start{0}; ///< of each pixel's words; one more at the end
    Words words;
};

struct Region {
    int left = 0;
    int top = 0;
    int right = 0;
    int bottom = 0;
};

RegionWords region_words(const Inputs& in, const Region& region) {
    const Camera& camera = in.tracer.scene().camera;
    Region box{region.right, region.bottom, region.left, region.top}; // of what differs
    for (int y = region.top; y < region.bottom; ++y)
        for (int x = region.left; x < region.right; ++x)
            if (in.cause.at(x, y) != no_difference)
                box = {std::min(box.left, x), std::min(box.top, y), std::max(box.right, x + 1),
                       std::max(box.bottom, y + 1)};
    RegionWords result;
    if (box.left >= box.right) return result;
    const auto ray = [&](int x, int y) { return ray_direction(camera, x + 0.5, y + 0.5); };
    const RegionLedger ledgers(in.tracer, in.silhouette,
                               {ray(box.left, box.top), ray(box.right - 1, box.top),
                                ray(box.right - 1, box.bottom - 1), ray(box.left, box.bottom - 1)});
    for (int y = box.top; y < box.bottom; ++y)
        for (int x = box.left; x < box.right; ++x) {
            if (in.cause.at(x, y) == no_difference) continue;
            const PixelLedger ledger = pixel_ledger(in.tracer, ledgers, in.truth, in.depths, x, y);
            append_words(in, ledger, in.truth.triangle.at(x, y), result.words);
            result.start.push_back(result.words.size());
        }
    return result;
}

struct HashWords {
    std::size_t operator()(const Words& words) const {
        return XXH3_64bits(words.data(), words.size() * sizeof(std::uint64_t));
    }
};

/// Fills a table in a fixed order, whoever found the ledgers.
class TableBuilder {
public:
    explicit TableBuilder(const Inputs& in) : in_(in), scene_(in.tracer.scene()) {}

    void add_pixel(int x, int y, std::span<const std::uint64_t> words) {
        const std::uint32_t seen = in_.truth.triangle.at(x, y);
        const std::uint32_t shown = in_.frame.triangle.at(x, y);
        table_.seen.push_back(seen);
        table_.shown.push_back(shown);
        table_.exactness.push_back(static_cast<std::uint8_t>(in_.truth.exactness.at(x, y)));
        need(seen);
        need(shown);
        // Neighbours mostly have the same.
        if (!std::equal(words.begin(), words.end(), last_.begin(), last_.end())) {
            last_.assign(words.begin(), words.end());
            const auto [place, is_new] =
                ledgers_.try_emplace(last_, static_cast<std::uint32_t>(ledgers_.size()));
            if (is_new) add_ledger(words);
            last_ledger_ = place->second;
        }
        table_.ledger.push_back(last_ledger_);
    }

    LedgerTable finish() {
        std::sort(triangles_.begin(), triangles_.end());
        triangles_.erase(std::unique(triangles_.begin(), triangles_.end()), triangles_.end());
        std::unordered_map<std::uint32_t, std::uint32_t> vertices;
        for (const std::uint32_t triangle : triangles_) {
            table_.triangle.push_back(triangle);
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t position = scene_.triangles[triangle][k];
                const auto [place, is_new] =
                    vertices.try_emplace(position, static_cast<std::uint32_t>(vertices.size()));
                table_.triangle.push_back(place->second);
                if (!is_new) continue;
                const glm::vec3& p = scene_.positions[position];
                table_.vertex.insert(table_.vertex.end(), {p.x, p.y, p.z});
            }
        }
        return std::move(table_);
    }

private:
    const Inputs& in_;
    const Scene& scene_;
    LedgerTable table_;
    Words last_;
    std::uint32_t last_ledger_ = 0;
    std::unordered_map<Words, std::uint32_t, HashWords> ledgers_;
    std::unordered_map<std::uint64_t, std::uint32_t> faces_;
    std::vector<std::uint32_t> triangles_;

    void need(std::uint32_t triangle) {
        if (triangle == no_triangle) return;
        if (!triangles_.empty() && triangles_.back() == triangle) return;
        triangles_.push_back(triangle);
    }

    void add_ledger(std::span<const std::uint64_t> words) {
        const auto high = [](std::uint64_t word) { return static_cast<std::int32_t>(word >> 32U); };
        const auto low = [](std::uint64_t word) { return static_cast<std::int32_t>(word); };
        table_.counts.insert(table_.counts.end(), {high(words[2]), high(words[0]), low(words[0]),
                                                   high(words[1]), low(words[1])});
        table_.adds_up.push_back(static_cast<std::uint8_t>(low(words[2])));
        for (const std::uint64_t word : words.subspan(count_words)) {
            const auto triangle = static_cast<std::uint32_t>(word >> 32U);
            const auto part = static_cast<std::uint32_t>(word >> 1U & 3U);
            const auto [place, is_new] = faces_.try_emplace(
                std::uint64_t{triangle} << 2U | part, static_cast<std::uint32_t>(faces_.size()));
            if (is_new) {
                table_.face.insert(table_.face.end(), {triangle, part});
                need(triangle);
            }
            table_.crossing_face.push_back(place->second);
            table_.crossing_change.push_back((word & 1U) != 0 ? std::int8_t{1} : std::int8_t{-1});
            table_.crossing_tally.push_back(static_cast<std::uint8_t>(word >> 8U & 0xffU));
        }
        table_.start.push_back(static_cast<std::uint32_t>(table_.crossing_face.size()));
    }
};

} // namespace

LedgerTable list_ledgers(const Tracer& tracer, const Silhouette& silhouette,
                         const GroundTruth& truth, const ShadowDepths& depths, const Frame& frame,
                         const Image<std::uint8_t>& cause) {
    const Inputs in{tracer, silhouette, truth, depths, frame, cause};
    TableBuilder builder(in);
    const int columns = (cause.width + region_side - 1) / region_side;
    // A band of regions at a time, so that what waits for its place in the table stays small.
    constexpr int rows_of_regions = 8;
    for (int top = 0; top < cause.height; top += region_side * rows_of_regions) {
        std::vector<RegionWords> found(static_cast<std::size_t>(columns) * rows_of_regions);
        parallel_for(static_cast<int>(found.size()), tracer.threads(), [&](int i, int) {
            const int left = i % columns * region_side;
            const int y = top + i / columns * region_side;
            found[static_cast<std::size_t>(i)] =
                region_words(in, {left, y, std::min(left + region_side, cause.width),
                                  std::min(y + region_side, cause.height)});
        });
        std::vector<std::size_t> next(found.size(), 0); // pixel of each region
        const int bottom = std::min(top + region_side * rows_of_regions, cause.height);
        for (int y = top; y < bottom; ++y)
            for (int x = 0; x < cause.width; ++x) {
                if (cause.at(x, y) == no_difference) continue;
                const auto i =
                    static_cast<std::size_t>((y - top) / region_side * columns + x / region_side);
                const RegionWords& region = found[i];
                const std::size_t pixel = next[i]++;
                builder.add_pixel(x, y,
                                  std::span(region.words)
                                      .subspan(region.start[pixel],
                                               region.start[pixel + 1] - region.start[pixel]));
            }
    }
    return builder.finish();
}

} // namespace shadowproof
