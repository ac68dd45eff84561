#include "compare/stencil/pixel_readings.h"
#include "compare/stencil/shared_faces.h"
#include "reference/predict/tally.h"

#include <algorithm>

namespace shadowproof {

namespace {

/// The sum of one sample's faces, none of them lost at a limit.
struct Sum {
    std::int64_t start = 0;
    std::int64_t dark_caps = 0;
    std::int64_t sum = 0;
    std::int64_t ideal = 0;
    std::int64_t off_ray = 0;
    bool in_cone = true;
    friend bool operator==(const Sum&, const Sum&) = default;
};

void add_sums(const PixelFaces& pixel, const Sample& sample, const SharedFaces& faces,
              std::vector<Sum>& sums) {
    std::int64_t nominal = 0;
    for (const auto& [key, face] : faces)
        if (face.nominally)
            nominal += weight(pixel.counting(), face.crossing) * face.crossing.change;
    Counting unlimited = pixel.counting();
    unlimited.operation = Counting::Operation::wrap;
    const std::vector<PossibleFace> possible = possible_faces(faces);
    const std::int64_t last = pixel.dark_caps(sample);
    for (const std::int32_t start : pixel.starts())
        for (const std::int64_t sum : possible_counts(possible, start, last, unlimited)) {
            const std::int64_t off = sum - nominal - start - last;
            const Sum found{start, last, sum, sample.ideal + off, off, sample.in_cone};
            if (std::find(sums.begin(), sums.end(), found) == sums.end()) sums.push_back(found);
        }
}

} // namespace

void add_mixed_samples(const PixelFaces& pixel, std::span<const RayTruth> truth,
                       std::vector<Reading>& readings) {
    std::vector<Sum> sums;
    SharedFaces faces;
    Sample sample; // in the end the last one that shows the surface
    bool is_first = true;
    for (std::size_t i = 0; i < pixel.around().rays.size(); ++i) {
        if (!pixel.take(i, truth, sample)) continue;
        const SharedFaces here = faces_of_sample(pixel, sample);
        add_sums(pixel, sample, here, sums);
        merge(here, is_first, faces);
        is_first = false;
    }
    const std::vector<PossibleFace> possible = possible_faces(faces);
    for (const Sum& sum : sums)
        for (const std::int64_t count :
             possible_counts_of_sum(possible, sum.start, sum.dark_caps, pixel.counting(), sum.sum))
            readings.push_back({.count = count,
                                .ideal = sum.ideal,
                                .in_cone = sum.in_cone,
                                .line = sample.line,
                                .depth = sample.depth,
                                .off_ray = sum.off_ray});
}

} // namespace shadowproof
