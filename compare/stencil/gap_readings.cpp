#include "compare/stencil/pixel_readings.h"
#include "compare/stencil/shared_faces.h"
#include "reference/predict/prediction.h"

#include <algorithm>

namespace shadowproof {

void add_in_gap(const PixelFaces& pixel, std::span<const RayTruth> truth,
                std::vector<Reading>& readings) {
    if (!pixel.may_gape() ||
        std::ranges::any_of(truth, [&](const RayTruth& t) { return t.triangle == pixel.shown(); }))
        return;
    SharedFaces faces;
    Sample sample; // in the end the last one that shows the surface
    bool is_first = true;
    for (std::size_t i = 0; i < pixel.around().rays.size(); ++i) {
        if (!pixel.take(i, truth, sample)) continue;
        merge(faces_of_sample(pixel, sample), is_first, faces);
        is_first = false;
    }
    if (is_first) return;
    const std::vector<PossibleFace> possible = possible_faces(faces);
    for (const std::int32_t start : pixel.starts())
        for (const std::int64_t count :
             possible_counts(possible, start, pixel.dark_caps(sample), pixel.counting()))
            readings.push_back({.count = count,
                                .ideal = sample.ideal,
                                .in_cone = truth[0].in_cone,
                                .by_rounding = true,
                                .line = sample.line,
                                .depth = sample.depth});
}

} // namespace shadowproof
