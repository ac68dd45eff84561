#include "compare/stencil/ledger_table.h"

#include "reference/parallel.h"
#include "reference/predict/pixel_ledger.h"
#include "reference/predict/tally.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <span>
#include <unordered_map>

namespace shadowproof {

namespace {

struct Inputs {
    const Tracer& tracer;
    const GroundTruth& truth;
    const Frame& frame;
    const Prediction& prediction;
    const Image<std::uint8_t>& cause;
};

struct Place {
    int x = 0;
    int y = 0;
};

/// A ledger as numbers, the same for pixels whose ledgers are the same.
using Words = std::vector<std::uint64_t>;

constexpr std::uint64_t pair(std::int32_t high, std::int32_t low) {
    return std::uint64_t{static_cast<std::uint32_t>(high)} << 32U | static_cast<std::uint32_t>(low);
}
constexpr std::int32_t high(std::uint64_t word) {
    return static_cast<std::int32_t>(word >> 32U);
}
constexpr std::int32_t low(std::uint64_t word) {
    return static_cast<std::int32_t>(word);
}

constexpr std::uint64_t crossing_word(std::uint32_t triangle, Crossing::Part part, int change,
                                      Tally tally) {
    return std::uint64_t{triangle} << 32U | static_cast<std::uint64_t>(tally) << 8U |
           static_cast<std::uint64_t>(part) << 1U | (change > 0 ? 1U : 0U);
}

constexpr std::size_t count_words = 4; ///< words before those of the crossings

void append_words(const Inputs& in, const PixelLedger& ledger, const Place& p, Words& words) {
    const std::uint32_t seen = in.truth.triangle.at(p.x, p.y);
    const RayCounts& counts = ledger.counts;
    words.push_back(pair(counts.at_near, counts.at_surface));
    words.push_back(pair(counts.at_far, counts.at_infinity));
    words.push_back(pair(counts.at_eye, ledger.adds_up ? 1 : 0));
    words.push_back(pair(in.prediction.let_through(p.x, p.y), in.prediction.counts().at(p.x, p.y)));
    for (const Crossing& crossing : ledger.crossings)
        words.push_back(
            crossing_word(crossing.triangle, crossing.part, crossing.change,
                          tally(crossing, ledger.surface, seen, in.prediction.depths().far,
                                in.frame.counted->counting, in.frame.depth_model)));
}

/// The differing pixels of one region, in rows from the top, and their ledgers.
struct Region {
    std::vector<Place> places;
    std::vector<std::size_t> start{0}; ///< of each place's words; one more at the end
    Words words;
};

void find_words(const Inputs& in, Region& region) {
    if (region.places.empty()) return;
    const Camera& camera = in.tracer.scene().camera;
    Place least = region.places.front();
    Place most = least;
    for (const Place& p : region.places) {
        least = {std::min(least.x, p.x), std::min(least.y, p.y)};
        most = {std::max(most.x, p.x), std::max(most.y, p.y)};
    }
    RegionLedger ledgers = in.prediction.volumes().ledger(
        corner_lines(camera, least.x, least.y, most.x + 1, most.y + 1));
    PixelLedger ledger;
    for (const Place& p : region.places) {
        find_pixel_ledger(in.tracer, ledgers, in.truth, in.prediction.depths(), p.x, p.y, ledger);
        append_words(in, ledger, p, region.words);
        region.start.push_back(region.words.size());
    }
}

/// All differing pixels, in rows from the top.
std::vector<Place> differing_places(const Image<std::uint8_t>& cause) {
    std::vector<Place> places;
    for (int y = 0; y < cause.height; ++y) {
        const std::uint8_t* row = cause.pixels.data() + cause.index(0, y);
        for (int x = 0; x < cause.width; ++x)
            if (row[x] != no_difference) places.push_back({x, y});
    }
    return places;
}

/// Fills a table in a fixed order, whichever thread found the ledgers.
class TableBuilder {
public:
    explicit TableBuilder(const Inputs& in)
        : in_(in), scene_(in.prediction.volumes().casters()),
          faces_(5 * scene_.triangles.size(), unnumbered), needed_(2 * scene_.triangles.size(), 0) {
    }

    void add_pixel(int x, int y, std::span<const std::uint64_t> words) {
        const std::uint32_t seen = in_.truth.triangle.at(x, y);
        const std::uint32_t shown = in_.frame.triangle.at(x, y);
        table_.shown.push_back(shown);
        need(seen);
        need(shown);
        table_.ledger.push_back(ledger_of(words));
    }

    std::uint64_t bytes() const {
        const auto of = [](const auto&... lists) {
            return (std::uint64_t{0} + ... + (lists.capacity() * sizeof(lists[0])));
        };
        return of(table_.shown, table_.ledger, table_.start, table_.counts, table_.adds_up,
                  table_.predicted, table_.crossing_face, table_.crossing_change,
                  table_.crossing_tally, table_.face);
    }

    LedgerTable finish() {
        append_triangles(scene_.positions, 0);
        if (const std::vector<glm::vec3>* ends = in_.prediction.volumes().far_ends())
            append_triangles(*ends, static_cast<std::uint32_t>(scene_.triangles.size()));
        return std::move(table_);
    }

private:
    static constexpr std::uint32_t unnumbered = 0xffffffffU;

    const Inputs& in_;
    const Scene& scene_;
    LedgerTable table_;
    std::unordered_map<std::uint64_t, std::uint32_t> ledgers_; ///< by the hash of their words
    std::vector<std::uint32_t> faces_; ///< 5 per triangle: each part's face, or unnumbered
    std::vector<std::uint8_t> needed_; ///< one flag per triangle, then those of the far ends

    /// Those that are needed of the triangles as they lie over `positions`, numbered from `offset`.
    void append_triangles(const std::vector<glm::vec3>& positions, std::uint32_t offset) {
        std::vector<std::uint32_t> vertices(positions.size(), unnumbered);
        for (std::uint32_t triangle = 0; triangle < scene_.triangles.size(); ++triangle) {
            if (needed_[offset + triangle] == 0) continue;
            table_.triangle.push_back(offset + triangle);
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t position = scene_.triangles[triangle][k];
                std::uint32_t& vertex = vertices[position];
                const bool is_new = vertex == unnumbered;
                if (is_new) vertex = static_cast<std::uint32_t>(table_.vertex.size() / 3);
                table_.triangle.push_back(vertex);
                if (!is_new) continue;
                const glm::vec3& p = positions[position];
                table_.vertex.insert(table_.vertex.end(), {p.x, p.y, p.z});
            }
        }
    }

    void need(std::uint32_t triangle) {
        if (triangle != no_triangle) needed_[triangle] = 1;
    }

    /// The ledger of these words, which is added where it is new.
    std::uint32_t ledger_of(std::span<const std::uint64_t> words) {
        // Another ledger with the same hash is one number further.
        for (std::uint64_t hash = XXH3_64bits(words.data(), words.size_bytes());; ++hash) {
            const auto count = static_cast<std::uint32_t>(table_.predicted.size());
            const auto [place, is_new] = ledgers_.try_emplace(hash, count);
            if (is_new) add_ledger(words);
            if (is_new || has_words(place->second, words)) return place->second;
        }
    }

    bool has_words(std::uint32_t ledger, std::span<const std::uint64_t> words) const {
        const std::int32_t* counts = table_.counts.data() + counts_of_ledger * std::size_t{ledger};
        if (words[0] != pair(counts[1], counts[2]) || words[1] != pair(counts[3], counts[4]) ||
            words[2] != pair(counts[0], table_.adds_up[ledger]) ||
            words[3] != pair(counts[5], table_.predicted[ledger]))
            return false;
        const std::size_t first = table_.start[ledger];
        if (table_.start[ledger + 1] - first != words.size() - count_words) return false;
        for (std::size_t i = 0; i < words.size() - count_words; ++i) {
            const std::size_t face = 2 * std::size_t{table_.crossing_face[first + i]};
            if (words[count_words + i] !=
                crossing_word(table_.face[face], static_cast<Crossing::Part>(table_.face[face + 1]),
                              table_.crossing_change[first + i],
                              static_cast<Tally>(table_.crossing_tally[first + i])))
                return false;
        }
        return true;
    }

    void add_ledger(std::span<const std::uint64_t> words) {
        const std::array<std::int32_t, counts_of_ledger> counts{high(words[2]), high(words[0]),
                                                                low(words[0]),  high(words[1]),
                                                                low(words[1]),  high(words[3])};
        table_.counts.insert(table_.counts.end(), counts.begin(), counts.end());
        table_.adds_up.push_back(static_cast<std::uint8_t>(low(words[2])));
        table_.predicted.push_back(low(words[3]));
        for (const std::uint64_t word : words.subspan(count_words)) {
            const auto triangle = static_cast<std::uint32_t>(word >> 32U);
            const auto part = static_cast<std::uint32_t>(word >> 1U & 7U);
            std::uint32_t& face = faces_[5 * std::size_t{triangle} + part];
            if (face == unnumbered) {
                face = static_cast<std::uint32_t>(table_.face.size() / 2);
                const auto count = static_cast<std::uint32_t>(scene_.triangles.size());
                const bool at_end = static_cast<Crossing::Part>(part) == Crossing::Part::dark_cap;
                table_.face.insert(table_.face.end(), {triangle, part});
                need(at_end ? count + triangle : triangle);
            }
            table_.crossing_face.push_back(face);
            table_.crossing_change.push_back((word & 1U) != 0 ? std::int8_t{1} : std::int8_t{-1});
            table_.crossing_tally.push_back(static_cast<std::uint8_t>(word >> 8U & 0xffU));
        }
        table_.start.push_back(static_cast<std::uint32_t>(table_.crossing_face.size()));
    }
};

} // namespace

LedgerTable list_ledgers(const Tracer& tracer, const GroundTruth& truth, const Frame& frame,
                         const Prediction& prediction, const Image<std::uint8_t>& cause,
                         const MemoryBudget& left) {
    const std::vector<Place> places = differing_places(cause);
    if (places.empty()) return {};
    const Inputs in{tracer, truth, frame, prediction, cause};
    TableBuilder builder(in);
    const auto columns = static_cast<std::size_t>((cause.width + region_side - 1) / region_side);
    const auto row_of = [](const Place& p) { return p.y / region_side; };
    const auto column_of = [](const Place& p) {
        return static_cast<std::size_t>(p.x / region_side);
    };
    // One row of regions at a time, so that little waits for its place in the table.
    for (auto begin = places.begin(); begin != places.end();) {
        const auto end = std::find_if(begin, places.end(),
                                      [&](const Place& p) { return row_of(p) != row_of(*begin); });
        std::vector<Region> regions(columns);
        for (auto p = begin; p != end; ++p) regions[column_of(*p)].places.push_back(*p);
        // A few pixels are not worth starting a thread.
        const int threads = end - begin < 256 ? 1 : tracer.threads();
        parallel_for(static_cast<int>(regions.size()), threads,
                     [&](int i, int) { find_words(in, regions[static_cast<std::size_t>(i)]); });
        std::vector<std::size_t> next(regions.size(), 0); // place of each region
        for (auto p = begin; p != end; ++p) {
            const Region& region = regions[column_of(*p)];
            const std::size_t i = next[column_of(*p)]++;
            builder.add_pixel(p->x, p->y,
                              std::span(region.words)
                                  .subspan(region.start[i], region.start[i + 1] - region.start[i]));
        }
        begin = end;
        // As much again for its text, and while a list grows.
        require_memory(left, program_bytes,
                       {2 * builder.bytes(), tracer.scene().file.string(),
                        fmt::format("what rays cross at {} pixels that differ", places.size()),
                        "try a smaller --size, or fewer volumes"});
    }
    return builder.finish();
}

} // namespace shadowproof
