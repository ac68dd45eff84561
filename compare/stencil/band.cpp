#include "compare/stencil/band.h"

#include "compare/stencil/pixel_readings.h"
#include "reference/predict/tally.h"

#include <algorithm>

namespace shadowproof {

std::vector<glm::dvec3> rays_between_outlines(const PixelVolumes& volumes, const Frame& frame,
                                              const Neighbourhood& around) {
    std::vector<SightPlane> planes = volumes.counted.outlines(around.corners);
    const auto add = [&](const std::vector<SightPlane>& more) {
        planes.insert(planes.end(), more.begin(), more.end());
    };
    // Volumes left open at infinity are counted to there, and a side ends in its vanishing line.
    if (tally_of_dark_caps(frame.counted->counting, frame.depth_model) == Tally::lost_cap)
        add(volumes.counted.vanishing_lines(around.corners));
    if (volumes.ideal != nullptr) add(volumes.ideal->outlines(around.corners));
    return rays_between(around, planes);
}

PixelBand find_band(const Tracer& tracer, const PixelVolumes& volumes, const Frame& frame,
                    double far, std::uint32_t shown, const Neighbourhood& around,
                    std::span<const RayTruth> truth,
                    const std::function<bool(const Reading&)>& matches) {
    const PixelFaces pixel(tracer, volumes, frame, far, shown, around, truth);
    PixelBand band;
    bool found = false;
    Sample sample;
    // Whether the surface is seen along the ray of that number.
    const auto look_along = [&](std::size_t rays, const std::function<bool(std::size_t)>& take) {
        for (std::size_t i = 0; i < rays && !found; ++i) {
            std::vector<Reading> readings;
            if (take(i)) add_sample(pixel, sample, readings);
            found = std::any_of(readings.begin(), readings.end(), matches);
            band.readings.insert(band.readings.end(), readings.begin(), readings.end());
        }
    };
    look_along(around.rays.size(), [&](std::size_t i) { return pixel.take(i, truth, sample); });
    if (!found && around.rays.size() > 1) {
        const std::vector<glm::dvec3> rays = rays_between_outlines(volumes, frame, around);
        look_along(rays.size(), [&](std::size_t i) {
            return pixel.take(rays[i], trace_ray(tracer, rays[i]), tracer.scene().camera.near,
                              sample);
        });
        if (!found) {
            if (pixel.counting().operation == Counting::Operation::saturate)
                add_mixed_samples(pixel, truth, band.readings);
            add_in_gap(pixel, truth, band.readings);
            add_edge_on_sides(pixel, band.readings);
            add_slivers(pixel, band.readings);
        }
    }
    sort_out(band.readings);
    return band;
}

} // namespace shadowproof
