#include "compare/classify.h"

#include "compare/coarse_outlines.h"
#include "compare/freedom.h"
#include "compare/pixel_cause.h"
#include "compare/surface_check.h"
#include "reference/parallel.h"

#include <algorithm>
#include <cassert>
#include <glm/vec2.hpp>
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
    finding.ledger_in_band =
        std::any_of(band.readings.begin(), band.readings.end(), [&](const Reading& reading) {
            return judged.stored(reading.count) == judged.read_back(p);
        });
    if (judged.differs(p)) finding.cause = cause_in_band(judged, p, band, around);
    return finding;
}

/// How closely pixels are looked at.
enum class Scrutiny : std::uint8_t { band, centre };

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

/// Pixels of one region of the picture, looked at together: what is gathered for the region serves
/// all of them.
struct Region {
    std::span<const PixelPlace> places;
    std::span<Finding> findings;
};

std::vector<Neighbourhood> neighbourhoods(const JudgedFrame& judged, const Region& region,
                                          Scrutiny scrutiny) {
    const Camera& camera = judged.tracer.scene().camera;
    const int left = region.places.front().x / region_side * region_side;
    const int top = region.places.front().y / region_side * region_side;
    RegionLedger ledger = judged.prediction.volumes().ledger(
        corner_rays(camera, left, top, left + region_side, top + region_side));
    std::vector<Crossing> crossings;
    std::vector<Neighbourhood> around;
    for (const PixelPlace& p : region.places) {
        const glm::dvec3 centre = ray_direction(camera, p.x + 0.5, p.y + 0.5);
        const BandRadius radius = scrutiny == Scrutiny::band
                                      ? band_radius(judged, p, centre, ledger, crossings)
                                      : BandRadius{};
        around.push_back(neighbourhood(camera, {p.x + 0.5, p.y + 0.5}, radius));
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

/// Finds what may be drawn at a pixel where that is what is true in a neighbourhood, which is the
/// pixel's own or one across a coarse outline. The ledgers must hold its rays.
Finding look_around_pixel(const JudgedFrame& judged, PixelPlace p, const Neighbourhood& around,
                          RegionLedger& counted, RegionLedger& ideal,
                          std::span<const RayTruth> truth) {
    const Volumes& volumes = judged.prediction.volumes();
    const PixelVolumes here{counted,
                            volumes.casters(),
                            volumes.far_ends(),
                            volumes.are_ideal() ? nullptr : &ideal,
                            volumes.touching_light(),
                            judged.prediction.depths().at_eye,
                            judged.prediction.ideal_depths().at_eye};
    const PixelBand band = find_band(
        judged.tracer, here, judged.frame, judged.depths.far, judged.frame.triangle.at(p.x, p.y),
        around, truth, [&](const Reading& reading) { return explains(judged, p, reading); });
    return look_around(judged, p, band, truth);
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
        RegionLedger counted_here(counted, around[i].corners);
        RegionLedger ideal_here(ideal, around[i].corners);
        const std::span<const RayTruth> truth = truths.first(around[i].rays.size());
        truths = truths.subspan(truth.size());
        region.findings[i] =
            look_around_pixel(judged, region.places[i], around[i], counted_here, ideal_here, truth);
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
                       Scrutiny scrutiny) {
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
std::vector<Finding> look_around(const JudgedFrame& judged, const std::vector<PixelPlace>& places) {
    std::vector<Finding> findings(places.size());
    std::ptrdiff_t unexplained = 0;
    for (std::size_t first = 0; first < places.size(); first += batch_size) {
        const std::size_t count = std::min(batch_size, places.size() - first);
        const std::span batch = std::span(findings).subspan(first, count);
        look_around_batch(judged, regions_of(std::span(places).subspan(first, count), batch),
                          unexplained < hopeless ? Scrutiny::band : Scrutiny::centre);
        unexplained += std::count_if(batch.begin(), batch.end(), [](const Finding& finding) {
            return !finding.ledger_in_band;
        });
    }
    return findings;
}

bool is_explained(const JudgedFrame& judged, PixelPlace p, const Finding& finding) {
    return finding.ledger_in_band && !(judged.differs(p) && finding.cause == Cause::unexplained);
}

/// What may be drawn at a pixel by an outline that the clipper has moved: what is true across one.
Finding look_across(const JudgedFrame& judged, PixelPlace p, const CoarseOutlines& outlines,
                    std::size_t most_places, const Finding& so_far) {
    const Camera& camera = judged.tracer.scene().camera;
    const Volumes& volumes = judged.prediction.volumes();
    const glm::dvec2 centre(p.x + 0.5, p.y + 0.5);
    const glm::dvec3 direction = ray_direction(camera, centre.x, centre.y);
    RegionLedger here = volumes.ledger(neighbourhood(camera, centre, {}).corners);
    std::vector<Crossing> crossings;
    const BandRadius radius = band_radius(judged, p, direction, here, crossings);
    const double step = std::max(radius.surface, radius.nearest);
    for (const glm::dvec2& place : outlines.places_across(centre, step, most_places)) {
        if (place.x < 0 || place.y < 0 || place.x > camera.width || place.y > camera.height)
            continue;
        const Neighbourhood around = neighbourhood(camera, place, radius);
        std::vector<RayTruth> truth;
        for (const glm::dvec3& ray : around.rays) truth.push_back(trace_ray(judged.tracer, ray));
        RegionLedger counted = volumes.ledger(around.corners);
        RegionLedger ideal = volumes.ideal_ledger(around.corners);
        const Finding found = look_around_pixel(judged, p, around, counted, ideal, truth);
        if (is_explained(judged, p, found)) return found;
    }
    return so_far;
}

/// Places looked at across coarse outlines: of one pixel, and of all pixels of a frame. Each takes
/// a few milliseconds where coordinates are huge, and a frame of which hundreds of pixels are
/// unexplained is judged in seconds all the same.
constexpr std::size_t most_places_of_pixel = 32;
constexpr std::size_t most_places_of_frame = 2048;

/// Looks once more at what nobody has explained.
void look_across_coarse_outlines(const JudgedFrame& judged, const std::vector<PixelPlace>& places,
                                 std::vector<Finding>& findings) {
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < places.size(); ++i)
        if (!is_explained(judged, places[i], findings[i])) open.push_back(i);
    if (open.empty() || std::ssize(open) > hopeless) return;
    const Scene& scene = judged.tracer.scene();
    const bool clips = judged.frame.depth_model.finite() && !judged.frame.counting.depth_clamp;
    const std::size_t most_places =
        std::clamp<std::size_t>(most_places_of_frame / open.size(), 2, most_places_of_pixel);
    const CoarseOutlines outlines(
        scene, judged.silhouette, judged.prediction.volumes().far_ends(),
        drawing_of(scene, judged.frame,
                   clips ? judged.depths.far : std::numeric_limits<double>::infinity()));
    parallel_for(static_cast<int>(open.size()), judged.tracer.threads(), [&](int k, int) {
        const std::size_t i = open[static_cast<std::size_t>(k)];
        findings[i] = look_across(judged, places[i], outlines, most_places, findings[i]);
    });
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

/// What is shown is evidence as the counter is: where no rasterizer would show it, nothing is
/// explained.
void check_surfaces(const JudgedFrame& judged, Comparison& comparison) {
    const SurfaceCheck check(judged.tracer, judged.frame, judged.depths.far);
    const int width = comparison.ledger_miss.width;
    Image<std::uint8_t> wrong(width, comparison.ledger_miss.height);
    parallel_for(wrong.height, judged.tracer.threads(), [&](int y, int) {
        for (int x = 0; x < width; ++x) wrong.at(x, y) = check.holds(x, y) ? 0 : 1;
    });
    for (int y = 0; y < wrong.height; ++y)
        for (int x = 0; x < width; ++x)
            if (wrong.at(x, y) != 0 && comparison.ledger_miss.at(x, y) == 0) {
                --(comparison.predicted.at(x, y) == judged.read_back({x, y})
                       ? comparison.ledger.equal
                       : comparison.ledger.in_band);
                record(comparison, {x, y}, false);
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
    std::vector<Finding> findings = look_around(judged, open);
    look_across_coarse_outlines(judged, open, findings);
    for (std::size_t i = 0; i < open.size(); ++i) {
        const PixelPlace p = open[i];
        record(comparison, p, findings[i].ledger_in_band);
        if (judged.differs(p))
            comparison.cause.at(p.x, p.y) = static_cast<std::uint8_t>(findings[i].cause);
    }
    check_surfaces(judged, comparison);
    if (!frame.color.pixels.empty()) check_colors(judged, comparison);
    count_causes(comparison);
    return comparison;
}

} // namespace shadowproof
