#include "compare/look_around.h"

#include "compare/driver/mask_errors.h"
#include "reference/parallel.h"

#include <algorithm>
#include <glm/vec2.hpp>
#include <iterator>
#include <limits>
#include <span>

namespace shadowproof {

namespace {

std::vector<Neighbourhood> neighbourhoods(const Case& tried, const Region& region) {
    const Camera& camera = tried.claim.traced.scene().camera;
    const std::vector<BandRadius> radii = tried.judge.radii(region.places);
    std::vector<Neighbourhood> around;
    for (std::size_t i = 0; i < region.places.size(); ++i) {
        around.push_back(
            neighbourhood(camera, {region.places[i].x + 0.5, region.places[i].y + 0.5}, radii[i]));
        if (has_masks(tried.claim.traced.scene())) read_masks_in_all_ways(around.back());
    }
    return around;
}

/// Sorts pixels by region, and regions so that the first ones are spread over the picture and tell
/// of all: Fibonacci hashing (Knuth, The Art of Computer Programming, volume 3, 6.4), one to one.
std::uint32_t scattered(const PixelPlace& p, int width) {
    const int regions_in_row = (width + region_side - 1) / region_side;
    const int region = p.y / region_side * regions_in_row + p.x / region_side;
    return static_cast<std::uint32_t>(region) * 2654435769U;
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

/// The truth along all rays of neighbourhoods, to which those are added that are as true where
/// floats move the planes that cut surfaces.
std::vector<RayTruth> truths_around(const Case& tried, std::span<Neighbourhood> around) {
    std::vector<glm::dvec3> rays;
    std::vector<MaskReading> readings;
    for (const Neighbourhood& pixel : around) {
        rays.insert(rays.end(), pixel.rays.begin(), pixel.rays.end());
        readings.insert(readings.end(), pixel.readings.begin(), pixel.readings.end());
    }
    const Scene& scene = tried.claim.traced.scene();
    const DepthModel& depth_model = tried.claim.frame.depth_model;
    const double far = depth_model.clips_at_far() ? tried.claim.traced.far()
                                                  : std::numeric_limits<double>::infinity();
    const DriverMaskErrors errors(scene, depth_model, drawing_of(scene, depth_model, far));
    return tried.cut.look_aside(around, trace_rays(tried.tracer(), rays, {readings, &errors}),
                                &errors);
}

void look_around_batch(const Case& tried, const std::vector<Region>& regions) {
    const auto for_regions = [&](const auto& work) {
        parallel_for(static_cast<int>(regions.size()), tried.tracer().threads(),
                     [&](int i, int) { work(static_cast<std::size_t>(i)); });
    };
    std::vector<std::vector<Neighbourhood>> of_regions(regions.size());
    for_regions([&](std::size_t i) { of_regions[i] = neighbourhoods(tried, regions[i]); });
    std::vector<Neighbourhood> around; // of all regions, one after the other
    for (std::vector<Neighbourhood>& region : of_regions)
        std::ranges::move(region, std::back_inserter(around));
    const std::vector<RayTruth> truths = truths_around(tried, around);
    std::vector<std::span<const Neighbourhood>> of_region;
    std::vector<std::size_t> first; // of each region's rays among all
    std::size_t pixels = 0;
    std::size_t rays = 0;
    for (const Region& region : regions) {
        of_region.push_back(std::span(around).subspan(pixels, region.places.size()));
        first.push_back(rays);
        pixels += region.places.size();
        for (const Neighbourhood& pixel : of_region.back()) rays += pixel.rays.size();
    }
    for_regions([&](std::size_t i) {
        tried.judge.look_around(regions[i], of_region[i], std::span(truths).subspan(first[i]));
    });
}

bool is_explained(const Case& tried, PixelPlace p, const Finding& finding) {
    return finding.evidence_in_band &&
           !(tried.claim.differs(p) && finding.cause.cause == Cause::unexplained);
}

/// What may be drawn at a pixel if the clipper displaces an outline: what is true across it.
Finding look_across(const Case& tried, PixelPlace p, const CoarseOutlines& outlines,
                    std::size_t most_places, const Finding& so_far) {
    const Camera& camera = tried.claim.traced.scene().camera;
    const BandRadius radius = tried.judge.radii(std::span(&p, 1)).front();
    const double step = std::max(radius.surface, radius.nearest);
    for (const glm::dvec2& place :
         outlines.places_across({p.x + 0.5, p.y + 0.5}, step, most_places)) {
        if (place.x < 0 || place.y < 0 || place.x > camera.width || place.y > camera.height)
            continue;
        Neighbourhood around = neighbourhood(camera, place, radius);
        const std::vector<RayTruth> truth = truths_around(tried, std::span(&around, 1));
        const Finding found = tried.judge.look_around(p, around, truth);
        if (is_explained(tried, p, found)) return found;
    }
    return so_far;
}

/// Limits of the places tried across coarse outlines: for one pixel, and for all pixels of a frame.
/// Each takes a few milliseconds if coordinates are huge; with these limits a frame with hundreds
/// of open pixels is still judged in seconds.
constexpr std::size_t most_places_of_pixel = 32;
constexpr std::size_t most_places_of_frame = 2048;

/// Pixels, by their numbers among `places`, that nothing explains so far.
using OpenPixels = std::vector<std::size_t>;

/// Tries once more to explain the open pixels.
void look_across_coarse_outlines(const Case& tried, std::span<const PixelPlace> places,
                                 const OpenPixels& open, std::vector<Finding>& findings) {
    const std::size_t most_places =
        std::clamp<std::size_t>(most_places_of_frame / open.size(), 2, most_places_of_pixel);
    const CoarseOutlines outlines = tried.judge.coarse_outlines();
    parallel_for(static_cast<int>(open.size()), tried.tracer().threads(), [&](int k, int) {
        const std::size_t i = open[static_cast<std::size_t>(k)];
        findings[i] = look_across(tried, places[i], outlines, most_places, findings[i]);
    });
}

/// The last attempt to explain pixels: by all faces, wherever they lie.
void look_at_all_faces(const Case& tried, std::span<const PixelPlace> places,
                       const OpenPixels& open, std::vector<Finding>& findings) {
    std::vector<PixelPlace> open_places;
    std::vector<Finding> found;
    for (const std::size_t i : open) {
        open_places.push_back(places[i]);
        found.push_back(findings[i]);
    }
    tried.judge.look_at_all_faces(open_places, found);
    for (std::size_t k = 0; k < open.size(); ++k) findings[open[k]] = found[k];
}

/// Looks further afield for what explains the open pixels. Leaves those that nothing explains.
void look_further(const Case& tried, std::span<const PixelPlace> places, OpenPixels& open,
                  std::vector<Finding>& findings) {
    const auto drop_explained = [&] {
        std::erase_if(open,
                      [&](std::size_t i) { return is_explained(tried, places[i], findings[i]); });
    };
    if (open.empty()) return;
    look_across_coarse_outlines(tried, places, open, findings);
    drop_explained();
    if (open.empty()) return;
    look_at_all_faces(tried, places, open, findings);
    drop_explained();
}

/// Pixels that are looked at together: few at first, then as many as keep the samples within a few
/// megabytes.
constexpr std::size_t first_batch = 64;
constexpr std::size_t largest_batch = 1024;

/// Whether looking around the pixels that are `left` is given up, after the evidence of `missed` of
/// `examined` ones from all over the picture was out of band: where many are left, and hardly any
/// is in band or very many are not. The verdict is certain then, and the others would take minutes.
/// A picture brings no evidence, is quickly looked at, and is never given up: its edges are told
/// from its faults, however many these are.
bool is_hopeless(std::size_t missed, std::size_t examined, std::size_t left) {
    constexpr std::size_t few = 512;
    constexpr std::size_t enough_to_tell = 64;
    constexpr std::size_t very_many = 2048;
    const bool hardly_any = missed >= enough_to_tell && 4 * missed >= 3 * examined;
    return left > few && (hardly_any || missed >= very_many);
}

} // namespace

std::vector<Finding> look_around(const Case& tried, std::vector<PixelPlace>& places) {
    const int width = tried.claim.frame.claim.width;
    std::ranges::stable_sort(places, {}, [&](const PixelPlace& p) { return scattered(p, width); });
    std::vector<Finding> findings(places.size());
    OpenPixels open;         // since pixels were last looked further for
    std::size_t missed = 0;  // of those before, with evidence out of band
    std::size_t enough = 64; // to look further before all have been looked around
    std::size_t count = first_batch;
    for (std::size_t first = 0; first < places.size(); first += count) {
        if (first > 0) count = std::min(2 * count, largest_batch);
        count = std::min(count, places.size() - first);
        look_around_batch(tried, regions_of(std::span(places).subspan(first, count),
                                            std::span(findings).subspan(first, count)));
        for (std::size_t i = first; i < first + count; ++i)
            if (!is_explained(tried, places[i], findings[i])) open.push_back(i);
        if (open.size() < enough) continue;
        look_further(tried, places, open, findings);
        missed += static_cast<std::size_t>(std::ranges::count_if(
            open, [&](std::size_t k) { return !findings[k].evidence_in_band; }));
        open.clear();
        enough *= 2;
        const std::size_t examined = first + count;
        if (is_hopeless(missed, examined, places.size() - examined)) return findings;
    }
    look_further(tried, places, open, findings);
    return findings;
}

} // namespace shadowproof
