#include "compare/classify.h"

#include "compare/band.h"
#include "compare/freedom.h"
#include "reference/parallel.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace shadowproof {

namespace {

struct PixelPlace {
    int x = 0;
    int y = 0;
};

/// What is asked at each pixel, and how it was counted.
struct Context {
    const Tracer& tracer;
    const Silhouette& silhouette;
    const GroundTruth& truth;
    const ShadowDepths& depths;
    const Frame& frame;
    const Prediction& prediction;
    std::vector<std::uint8_t> receives; ///< a flag a triangle

    std::uint32_t stored(std::int64_t count) const {
        return shadowproof::stored(count, frame.counting);
    }
    std::int64_t predicted(PixelPlace p) const { return prediction.counts().at(p.x, p.y); }
    std::uint32_t read_back(PixelPlace p) const { return frame.counter.at(p.x, p.y); }
    /// Shadow depths in the volumes that the shadows ask for.
    const ShadowDepths& ideal() const {
        return prediction.volumes().are_ideal() ? prediction.depths() : depths;
    }
    bool surface_as_true(PixelPlace p) const {
        return frame.triangle.at(p.x, p.y) == truth.triangle.at(p.x, p.y);
    }
    bool differs(PixelPlace p) const {
        return frame.claim.at(p.x, p.y) != truth.visibility.at(p.x, p.y);
    }
};

/// The claim that follows from a counter and a triangle, where the light shines or not.
Visibility claim_of(const Context& context, std::int64_t count, std::uint32_t triangle,
                    bool in_cone) {
    if (triangle == no_triangle) return Visibility::background;
    const bool unshadowed = context.receives[triangle] == 0 || context.stored(count) == 0;
    const bool lit = in_cone && unshadowed && sides_of(context.tracer, triangle).faces_light();
    return lit ? Visibility::lit : Visibility::shadowed;
}

/// Where faces in front of the surface are counted, and the counter does not begin with what is
/// lost of them.
std::optional<Cause> cause_at_near_plane(const Counting& counting, const Reading& reading) {
    switch (counting.start) {
    case Counting::Start::zero:
        return reading.at_eye != 0 ? Cause::eye_inside : Cause::near_plane;
    case Counting::Start::eye:
        return Cause::near_plane;
    case Counting::Start::near_plane:
        break;
    }
    return std::nullopt;
}

/// Why a technique that counted `reading` shows another claim than the truth, where its surface is
/// the true one. Nothing where the algorithm itself would be right.
std::optional<Cause> algorithmic_cause(const Context& context, const Reading& reading,
                                       Visibility true_visibility) {
    const bool counted_lit = context.stored(reading.count) == 0;
    const bool ideally_lit = reading.ideal == 0;
    const bool truly_lit = true_visibility == Visibility::lit;
    if (counted_lit == truly_lit) return std::nullopt;
    // The counter tells what it ought to, and is still wrong: the mesh does not enclose a volume.
    if (counted_lit == ideally_lit && reading.count == reading.ideal)
        return truly_lit ? std::nullopt : std::optional(Cause::open_mesh);
    const Counting& counting = context.frame.counting;
    if (counting.operation == Counting::Operation::saturate) return Cause::counter;
    if (counted_lit && reading.count != 0)
        return counting.operation == Counting::Operation::invert ? Cause::parity : Cause::counter;
    if (std::isfinite(counting.extrusion)) return Cause::extrusion;
    // Filled holes shadow what the open caster does not.
    if (counting.holes_filled && reading.count != reading.ideal) return Cause::open_mesh;
    if (!counting.light_cap) return Cause::cap;
    if (counting.test == Counting::Test::depth_pass) return cause_at_near_plane(counting, reading);
    if (context.frame.depth_model.finite() && !counting.depth_clamp) return Cause::far_plane;
    if (!counting.dark_cap) return Cause::cap;
    return std::nullopt;
}

/// The reading at the pixel's centre, as traced.
Reading centre_reading(const Context& context, PixelPlace p) {
    const Image<std::uint8_t>& in_cone = context.truth.in_cone;
    const ShadowDepths& ideal = context.ideal();
    return {context.predicted(p), ideal.at_surface.at(p.x, p.y), ideal.at_eye,
            in_cone.pixels.empty() || in_cone.at(p.x, p.y) != 0, false};
}

/// Where read-back and prediction agree at the centre, the cause is the algorithm's own.
std::optional<Cause> cause_at_centre(const Context& context, PixelPlace p) {
    const Reading reading = centre_reading(context, p);
    const std::uint32_t triangle = context.truth.triangle.at(p.x, p.y);
    if (!context.surface_as_true(p) || triangle == no_triangle) return std::nullopt;
    if (context.stored(reading.count) != context.read_back(p)) return std::nullopt;
    if (claim_of(context, reading.count, triangle, reading.in_cone) !=
        context.frame.claim.at(p.x, p.y))
        return std::nullopt;
    return algorithmic_cause(context, reading, context.truth.visibility.at(p.x, p.y));
}

/// Whether the pixel needs no look at its surroundings.
bool settled(const Context& context, PixelPlace p, std::optional<Cause>& cause) {
    const bool counted =
        context.surface_as_true(p) && context.stored(context.predicted(p)) == context.read_back(p);
    if (!context.differs(p)) return counted;
    cause = cause_at_centre(context, p);
    return counted && cause.has_value();
}

/// Whether a reading is what was read back, and leads to the claim that was made.
bool explains(const Context& context, PixelPlace p, const Reading& reading) {
    return context.stored(reading.count) == context.read_back(p) &&
           claim_of(context, reading.count, context.frame.triangle.at(p.x, p.y), reading.in_cone) ==
               context.frame.claim.at(p.x, p.y);
}

/// What was found at one pixel by looking at its band.
struct Finding {
    bool ledger_in_band = false;
    Cause cause = Cause::unexplained;
};

Cause cause_in_band(const Context& context, PixelPlace p, const PixelBand& band,
                    std::span<const RayTruth> around) {
    const Visibility claim = context.frame.claim.at(p.x, p.y);
    if (context.truth.exactness.at(p.x, p.y) == Exactness::degenerate) return Cause::edge;
    if (const std::optional<Cause> cause = cause_at_centre(context, p)) return *cause;
    if (std::any_of(around.begin(), around.end(),
                    [&](const RayTruth& t) { return t.visibility == claim; }))
        return Cause::edge;

    const std::uint32_t shown = context.frame.triangle.at(p.x, p.y);
    // What is true of the surface shown, where it is seen next to the centre.
    const auto seen = std::find_if(around.begin(), around.end(),
                                   [&](const RayTruth& t) { return t.triangle == shown; });
    const Visibility truth_of_shown =
        seen != around.end() ? seen->visibility : context.truth.visibility.at(p.x, p.y);
    std::optional<Cause> algorithmic;
    for (const Reading& reading : band.readings) {
        if (!explains(context, p, reading)) continue;
        // What ought to be counted makes this claim, too, with faces moved in depth.
        if (reading.moved_in_depth &&
            claim_of(context, reading.ideal, shown, reading.in_cone) == claim)
            return Cause::precision;
        if (!algorithmic) algorithmic = algorithmic_cause(context, reading, truth_of_shown);
    }
    return algorithmic.value_or(Cause::unexplained);
}

Finding look_around(const Context& context, PixelPlace p, const PixelBand& band,
                    std::span<const RayTruth> around) {
    Finding finding;
    const bool degenerate = context.truth.exactness.at(p.x, p.y) == Exactness::degenerate;
    finding.ledger_in_band =
        degenerate ||
        std::any_of(band.readings.begin(), band.readings.end(), [&](const Reading& reading) {
            return context.stored(reading.count) == context.read_back(p);
        });
    if (context.differs(p)) finding.cause = cause_in_band(context, p, band, around);
    return finding;
}

/// How closely pixels are looked at.
enum class Scrutiny : std::uint8_t { band, centre };

/// The pixel's freedom to each side. `ledger` must hold the ray.
BandRadius band_radius(const Context& context, PixelPlace p, const glm::dvec3& direction,
                       RegionLedger& ledger, std::vector<Crossing>& crossings) {
    const Scene& scene = context.tracer.scene();
    const auto at = [&](double depth) {
        return lateral_freedom(scene, context.frame.depth_model,
                               scene.camera.eye + depth * direction);
    };
    const double surface = std::min(context.truth.depth.at(p.x, p.y), context.depths.far);
    double nearest = surface;
    const Counting& counting = context.frame.counting;
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

std::vector<Neighbourhood> neighbourhoods(const Context& context, const Region& region,
                                          Scrutiny scrutiny) {
    const Camera& camera = context.tracer.scene().camera;
    const int left = region.places.front().x / region_side * region_side;
    const int top = region.places.front().y / region_side * region_side;
    RegionLedger ledger = context.prediction.volumes().ledger(
        corner_rays(camera, left, top, left + region_side, top + region_side));
    std::vector<Crossing> crossings;
    std::vector<Neighbourhood> around;
    for (const PixelPlace& p : region.places) {
        const glm::dvec3 centre = ray_direction(camera, p.x + 0.5, p.y + 0.5);
        const BandRadius radius = scrutiny == Scrutiny::band
                                      ? band_radius(context, p, centre, ledger, crossings)
                                      : BandRadius{};
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
void look_around_region(const Context& context, const Region& region,
                        const std::vector<Neighbourhood>& around,
                        std::span<const RayTruth> truths) {
    const std::array<glm::dvec3, 4> corners =
        corners_around(context.tracer.scene().camera, region, around);
    const Volumes& volumes = context.prediction.volumes();
    const RegionLedger counted = volumes.ledger(corners);
    const RegionLedger ideal(context.tracer, context.silhouette, corners);
    for (std::size_t i = 0; i < region.places.size(); ++i) {
        const PixelPlace p = region.places[i];
        RegionLedger counted_here(counted, around[i].corners);
        RegionLedger ideal_here(ideal, around[i].corners);
        const PixelVolumes here{counted_here,
                                volumes.casters(),
                                volumes.far_ends(),
                                volumes.are_ideal() ? nullptr : &ideal_here,
                                context.prediction.depths().at_eye,
                                context.ideal().at_eye};
        const std::span<const RayTruth> truth = truths.first(around[i].rays.size());
        truths = truths.subspan(truth.size());
        const PixelBand band =
            find_band(context.tracer, here, context.frame, context.depths.far,
                      context.frame.triangle.at(p.x, p.y), around[i], truth,
                      [&](const Reading& reading) { return explains(context, p, reading); });
        region.findings[i] = look_around(context, p, band, truth);
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

void look_around_batch(const Context& context, const std::vector<Region>& regions,
                       Scrutiny scrutiny) {
    const auto for_regions = [&](const auto& work) {
        parallel_for(static_cast<int>(regions.size()), context.tracer.threads(),
                     [&](int i, int) { work(static_cast<std::size_t>(i)); });
    };
    std::vector<std::vector<Neighbourhood>> around(regions.size());
    for_regions([&](std::size_t i) { around[i] = neighbourhoods(context, regions[i], scrutiny); });
    std::vector<std::size_t> first; // of each region's rays among all
    std::vector<glm::dvec3> rays;
    for (const std::vector<Neighbourhood>& region : around) {
        first.push_back(rays.size());
        for (const Neighbourhood& pixel : region)
            rays.insert(rays.end(), pixel.rays.begin(), pixel.rays.end());
    }
    const std::vector<RayTruth> truths = trace_rays(context.tracer, rays);
    for_regions([&](std::size_t i) {
        look_around_region(context, regions[i], around[i], std::span(truths).subspan(first[i]));
    });
}

/// `places` sorted by region.
std::vector<Finding> look_around(const Context& context, const std::vector<PixelPlace>& places) {
    std::vector<Finding> findings(places.size());
    std::ptrdiff_t unexplained = 0;
    for (std::size_t first = 0; first < places.size(); first += batch_size) {
        const std::size_t count = std::min(batch_size, places.size() - first);
        const std::span batch = std::span(findings).subspan(first, count);
        look_around_batch(context, regions_of(std::span(places).subspan(first, count), batch),
                          unexplained < hopeless ? Scrutiny::band : Scrutiny::centre);
        unexplained += std::count_if(batch.begin(), batch.end(), [](const Finding& finding) {
            return !finding.ledger_in_band;
        });
    }
    return findings;
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

} // namespace

Comparison classify(const Tracer& tracer, const Silhouette& silhouette, const GroundTruth& truth,
                    const ShadowDepths& depths, const Frame& frame, const Prediction& prediction) {
    const int width = truth.visibility.width;
    const int height = truth.visibility.height;
    assert(frame.claim.width == width && frame.claim.height == height);
    const Context context{
        tracer, silhouette, truth, depths, frame, prediction, receiving_triangles(tracer.scene())};

    Comparison comparison;
    comparison.cause = Image<std::uint8_t>(width, height, no_difference);
    comparison.ledger_miss = Image<std::uint8_t>(width, height);
    comparison.predicted = Image<std::uint32_t>(width, height);
    std::vector<PixelPlace> open;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const PixelPlace p{x, y};
            comparison.predicted.at(x, y) = context.stored(context.predicted(p));
            std::optional<Cause> cause;
            if (!settled(context, p, cause)) {
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
    const std::vector<Finding> findings = look_around(context, open);
    for (std::size_t i = 0; i < open.size(); ++i) {
        const PixelPlace p = open[i];
        record(comparison, p, findings[i].ledger_in_band);
        if (context.differs(p))
            comparison.cause.at(p.x, p.y) = static_cast<std::uint8_t>(findings[i].cause);
    }
    count_causes(comparison);
    return comparison;
}

} // namespace shadowproof
