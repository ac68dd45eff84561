#include "compare/classify.h"

#include "compare/coarse_outlines.h"
#include "compare/freedom.h"
#include "compare/pixel_cause.h"
#include "reference/parallel.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace shadowproof {

namespace {

/// What was found at one pixel by looking at its band.
struct Finding {
    bool ledger_in_band = false;
    Cause cause = Cause::unexplained;
};

Finding look_around(const JudgedFrame& judged, PixelPlace p, const PixelBand& band,
                    std::span<const RayTruth> around) {
    Finding finding;
    const bool degenerate = judged.truth.exactness.at(p.x, p.y) == Exactness::degenerate;
    finding.ledger_in_band =
        degenerate ||
        std::any_of(band.readings.begin(), band.readings.end(), [&](const Reading& reading) {
            return judged.stored(reading.count) == judged.read_back(p);
        });
    if (judged.differs(p)) finding.cause = cause_in_band(judged, p, band, around);
    return finding;
}

/// How closely pixels are looked at.
struct Scrutiny {
    bool band = true;                         ///< else at their centres only
    const CoarseOutlines* outlines = nullptr; ///< that may be drawn further aside, where asked for
};

/// The pixel's freedom to each side. `ledger` must hold the ray.
BandRadius band_radius(const JudgedFrame& judged, PixelPlace p, const glm::dvec3& direction,
                       RegionLedger& ledger, std::vector<Crossing>& crossings) {
    const Scene& scene = judged.tracer.scene();
    const auto at = [&](double depth) {
        return lateral_freedom(scene, judged.frame.depth_model,
                               scene.camera.eye + depth * direction);
    };
    const double surface = std::min(judged.truth.depth.at(p.x, p.y), judged.depths.far);
    double nearest = surface;
    const Counting& counting = judged.frame.counting;
    if (counting.test == Counting::Test::depth_pass || !counting.casters.empty()) {
        ledger.crossings(direction, crossings);
        for (const Crossing& crossing : crossings)
            if (crossing.depth >= scene.camera.near &&
                counting.caster(crossing.triangle).test == Counting::Test::depth_pass)
                nearest = std::min(nearest, crossing.depth);
    }
    return {at(surface), at(nearest)};
}

/// The same where clipping may have moved outlines further.
BandRadius coarse_radius(const JudgedFrame& judged, PixelPlace p, const CoarseOutlines& outlines,
                         const BandRadius& radius) {
    const double reach = std::max(radius.surface, radius.nearest);
    const double picture = std::max(judged.truth.visibility.width, judged.truth.visibility.height);
    const double coarse = outlines.reach_at({p.x + 0.5, p.y + 0.5}, reach);
    return {radius.surface, std::max(radius.nearest, std::min(coarse + reach, picture))};
}

/// Pixels of one region of the picture, looked at together: what is gathered for the region serves
/// all of them.
struct Region {
    std::span<const PixelPlace> places;
    std::span<Finding> findings;
};

std::vector<Neighbourhood> neighbourhoods(const JudgedFrame& judged, const Region& region,
                                          const Scrutiny& scrutiny) {
    const Camera& camera = judged.tracer.scene().camera;
    const int left = region.places.front().x / region_side * region_side;
    const int top = region.places.front().y / region_side * region_side;
    RegionLedger ledger = judged.prediction.volumes().ledger(
        corner_rays(camera, left, top, left + region_side, top + region_side));
    std::vector<Crossing> crossings;
    std::vector<Neighbourhood> around;
    for (const PixelPlace& p : region.places) {
        const glm::dvec3 centre = ray_direction(camera, p.x + 0.5, p.y + 0.5);
        BandRadius radius;
        if (scrutiny.band) radius = band_radius(judged, p, centre, ledger, crossings);
        if (scrutiny.band && scrutiny.outlines != nullptr)
            radius = coarse_radius(judged, p, *scrutiny.outlines, radius);
        around.push_back(neighbourhood(camera, p.x, p.y, radius));
    }
    return around;
}

/// The rays of a region's pixels and of all that they may be moved to.
std::array<glm::dvec3, 4> corners_around(const Camera& camera, const Region& region,
                                         const std::vector<Neighbourhood>& around) {
    const int left = region.places.front().x / region_side * region_side;
    const int top = region.places.front().y / region_side * region_side;
    double reach = 0;
    for (const Neighbourhood& each : around) reach = std::max(reach, each.reach);
    return corner_rays(camera, left - reach, top - reach, left + region_side + reach,
                       top + region_side + reach);
}

/// `truths`: of the rays around the region's pixels, one pixel after the other.
void look_around_region(const JudgedFrame& judged, const Region& region,
                        const std::vector<Neighbourhood>& around,
                        std::span<const RayTruth> truths) {
    const std::array<glm::dvec3, 4> corners =
        corners_around(judged.tracer.scene().camera, region, around);
    const Volumes& volumes = judged.prediction.volumes();
    const RegionLedger counted = volumes.ledger(corners);
    const RegionLedger ideal = volumes.ideal_ledger(corners);
    for (std::size_t i = 0; i < region.places.size(); ++i) {
        const PixelPlace p = region.places[i];
        RegionLedger counted_here(counted, around[i].corners);
        RegionLedger ideal_here(ideal, around[i].corners);
        const PixelVolumes here{counted_here,
                                volumes.casters(),
                                volumes.far_ends(),
                                volumes.are_ideal() ? nullptr : &ideal_here,
                                volumes.touching_light(),
                                judged.prediction.depths().at_eye,
                                judged.prediction.ideal_depths().at_eye};
        const std::span<const RayTruth> truth = truths.first(around[i].rays.size());
        truths = truths.subspan(truth.size());
        const PixelBand band =
            find_band(judged.tracer, here, judged.frame, judged.depths.far,
                      judged.frame.triangle.at(p.x, p.y), around[i], truth,
                      [&](const Reading& reading) { return explains(judged, p, reading); });
        region.findings[i] = look_around(judged, p, band, truth);
    }
}

/// Runs of pixels, sorted by region, that lie in one region.
std::vector<Region> regions_of(std::span<const PixelPlace> places, std::span<Finding> findings) {
    const auto same = [](const PixelPlace& a, const PixelPlace& b) {
        return a.x / region_side == b.x / region_side && a.y / region_side == b.y / region_side;
    };
    std::vector<Region> regions;
    for (std::size_t begin = 0, end = 0; begin < places.size(); begin = end) {
        while (end < places.size() && same(places[begin], places[end])) ++end;
        regions.push_back(
            {places.subspan(begin, end - begin), findings.subspan(begin, end - begin)});
    }
    return regions;
}

/// Pixels looked at together: as many as keep the samples within a few megabytes.
constexpr std::size_t batch_size = 1024;

/// Once so many pixels are beyond explanation, the verdict is beyond doubt, and it would take
/// minutes to search the bands of all others: they are looked at in their centres only.
constexpr std::ptrdiff_t hopeless = 2048;

void look_around_batch(const JudgedFrame& judged, const std::vector<Region>& regions,
                       const Scrutiny& scrutiny) {
    const auto for_regions = [&](const auto& work) {
        parallel_for(static_cast<int>(regions.size()), judged.tracer.threads(),
                     [&](int i, int) { work(static_cast<std::size_t>(i)); });
    };
    std::vector<std::vector<Neighbourhood>> around(regions.size());
    for_regions([&](std::size_t i) { around[i] = neighbourhoods(judged, regions[i], scrutiny); });
    std::vector<std::size_t> first; // of each region's rays among all
    std::vector<glm::dvec3> rays;
    for (const std::vector<Neighbourhood>& region : around) {
        first.push_back(rays.size());
        for (const Neighbourhood& pixel : region)
            rays.insert(rays.end(), pixel.rays.begin(), pixel.rays.end());
    }
    const std::vector<RayTruth> truths = trace_rays(judged.tracer, rays);
    for_regions([&](std::size_t i) {
        look_around_region(judged, regions[i], around[i], std::span(truths).subspan(first[i]));
    });
}

/// `places` sorted by region.
std::vector<Finding> look_around(const JudgedFrame& judged, const std::vector<PixelPlace>& places,
                                 const CoarseOutlines* outlines) {
    std::vector<Finding> findings(places.size());
    std::ptrdiff_t unexplained = 0;
    for (std::size_t first = 0; first < places.size(); first += batch_size) {
        const std::size_t count = std::min(batch_size, places.size() - first);
        const std::span batch = std::span(findings).subspan(first, count);
        look_around_batch(judged, regions_of(std::span(places).subspan(first, count), batch),
                          {unexplained < hopeless, outlines});
        unexplained += std::count_if(batch.begin(), batch.end(), [](const Finding& finding) {
            return !finding.ledger_in_band;
        });
    }
    return findings;
}

bool is_explained(const JudgedFrame& judged, PixelPlace p, const Finding& finding) {
    return finding.ledger_in_band && !(judged.differs(p) && finding.cause == Cause::unexplained);
}

/// Looks once more at what nobody has explained, with outlines where clipping may have moved them.
void look_at_coarse_outlines(const JudgedFrame& judged, const std::vector<PixelPlace>& places,
                             std::vector<Finding>& findings) {
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < places.size(); ++i)
        if (!is_explained(judged, places[i], findings[i])) open.push_back(i);
    if (open.empty()) return;
    const Scene& scene = judged.tracer.scene();
    const DepthModel& model = judged.frame.depth_model;
    const bool clips = model.finite() && !judged.frame.counting.depth_clamp;
    const CoarseOutlines outlines(
        scene, judged.silhouette, judged.prediction.volumes().far_ends(),
        drawing_of(scene, judged.frame,
                   clips ? judged.depths.far : std::numeric_limits<double>::infinity()));
    std::vector<PixelPlace> open_places;
    for (const std::size_t i : open) open_places.push_back(places[i]);
    const std::vector<Finding> found = look_around(judged, open_places, &outlines);
    for (std::size_t k = 0; k < open.size(); ++k)
        if (is_explained(judged, open_places[k], found[k])) findings[open[k]] = found[k];
}

void record(Comparison& comparison, PixelPlace p, bool in_band) {
    LedgerCheck& ledger = comparison.ledger;
    if (in_band) {
        ++ledger.in_band;
        return;
    }
    if (ledger.unexplained++ == 0 ||
        std::pair(p.y, p.x) < std::pair(ledger.first_y, ledger.first_x)) {
        ledger.first_x = p.x;
        ledger.first_y = p.y;
    }
    comparison.ledger_miss.at(p.x, p.y) = 1;
}

/// Which of two causes a person should see first: unexplained, then any failing, then edge.
int urgency(Cause cause) {
    if (cause == Cause::unexplained) return 2;
    return cause == Cause::edge ? 0 : 1;
}

void count_causes(Comparison& comparison) {
    for (int y = 0; y < comparison.cause.height; ++y)
        for (int x = 0; x < comparison.cause.width; ++x) {
            const std::uint8_t value = comparison.cause.at(x, y);
            if (value == no_difference) continue;
            const auto cause = static_cast<Cause>(value);
            ++comparison.causes[value];
            ++comparison.differing;
            if (!comparison.first || urgency(cause) > urgency(comparison.first->cause))
                comparison.first = FirstDifference{x, y, cause};
        }
}

/// Colours differ where they are beyond their bounds; where visibility differs, they are not
/// judged.
void check_colors(const JudgedFrame& judged, Comparison& comparison) {
    comparison.colors = check_colors(judged.tracer, judged.truth, judged.frame);
    const Image<ColorVerdict>& verdicts = comparison.colors->verdict;
    for (int y = 0; y < verdicts.height; ++y)
        for (int x = 0; x < verdicts.width; ++x) {
            const ColorVerdict verdict = verdicts.at(x, y);
            const Cause cause =
                verdict == ColorVerdict::beyond ? Cause::shading : Cause::unexplained;
            if (verdict == ColorVerdict::beyond || verdict == ColorVerdict::unexplained)
                comparison.cause.at(x, y) = static_cast<std::uint8_t>(cause);
        }
}

} // namespace

Comparison classify(const Tracer& tracer, const Silhouette& silhouette, const GroundTruth& truth,
                    const ShadowDepths& depths, const Frame& frame, const Prediction& prediction) {
    const int width = truth.visibility.width;
    const int height = truth.visibility.height;
    assert(frame.claim.width == width && frame.claim.height == height);
    const JudgedFrame judged{
        tracer, silhouette, truth, depths, frame, prediction, receiving_triangles(tracer.scene())};

    Comparison comparison;
    comparison.cause = Image<std::uint8_t>(width, height, no_difference);
    comparison.ledger_miss = Image<std::uint8_t>(width, height);
    comparison.predicted = Image<std::uint32_t>(width, height);
    std::vector<PixelPlace> open;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const PixelPlace p{x, y};
            comparison.predicted.at(x, y) = judged.stored(judged.predicted(p));
            std::optional<Cause> cause;
            if (!settled(judged, p, cause)) {
                open.push_back(p);
                continue;
            }
            ++comparison.ledger.equal;
            if (cause) comparison.cause.at(x, y) = static_cast<std::uint8_t>(*cause);
        }

    const auto region_of = [](const PixelPlace& p) {
        return std::pair(p.y / region_side, p.x / region_side);
    };
    std::stable_sort(open.begin(), open.end(), [&](const PixelPlace& a, const PixelPlace& b) {
        return region_of(a) < region_of(b);
    });
    std::vector<Finding> findings = look_around(judged, open, nullptr);
    look_at_coarse_outlines(judged, open, findings);
    for (std::size_t i = 0; i < open.size(); ++i) {
        const PixelPlace p = open[i];
        record(comparison, p, findings[i].ledger_in_band);
        if (judged.differs(p))
            comparison.cause.at(p.x, p.y) = static_cast<std::uint8_t>(findings[i].cause);
    }
    if (!frame.color.pixels.empty()) check_colors(judged, comparison);
    count_causes(comparison);
    return comparison;
}

} // namespace shadowproof
