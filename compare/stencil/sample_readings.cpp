#include "compare/stencil/pixel_readings.h"
#include "reference/predict/prediction.h"

#include <utility>

namespace shadowproof {

namespace {

CountOfSum nominal_count(const std::vector<CandidateFace>& faces, std::int64_t start,
                         std::int64_t last, const Counting& counting) {
    std::vector<PossibleFace> drawn;
    for (const CandidateFace& face : faces)
        if (face.nominally) drawn.push_back({face.crossing, true});
    return possible_sums(std::move(drawn), start, last, counting).front();
}

/// All values that the counter may have with uncertain faces counted or not.
std::vector<CountOfSum> counts_with_uncertain(const std::vector<CandidateFace>& faces,
                                              std::int64_t start, std::int64_t last,
                                              const Counting& counting) {
    std::vector<PossibleFace> possible;
    for (const CandidateFace& face : faces)
        if (!face.certain || face.nominally) possible.push_back({face.crossing, face.certain});
    return possible_sums(std::move(possible), start, last, counting);
}

/// Readings with the clipping planes moved.
void add_clipped(const PixelFaces& pixel, const Sample& sample, const ClipDepths& clip,
                 std::vector<Reading>& readings) {
    const Counting& counting = pixel.counting();
    const std::vector<CandidateFace> faces = pixel.candidates(sample, clip);
    const std::int64_t last = pixel.dark_caps(sample);
    const std::int32_t start =
        start_of(counting, pixel.volumes().counted_at_eye, pixel.depth_at_near(sample));
    // A reading off the nominal one by faces in front or behind moves the ideal one with it.
    const CountOfSum nominal = nominal_count(faces, start, last, counting);
    const auto add = [&](const CountOfSum& found) {
        const std::int64_t off = found.sum - nominal.sum;
        const bool rounded = sample.moved || clip.moved || found != nominal;
        readings.push_back({found.count, sample.ideal + off, sample.in_cone, rounded,
                            sample.direction, sample.depth, off});
    };
    if (!clip.moved) add(nominal);
    for (const std::int32_t other : pixel.starts())
        for (const CountOfSum& found : counts_with_uncertain(faces, other, last, counting))
            add(found);
}

} // namespace

void add_sample(const PixelFaces& pixel, const Sample& sample, std::vector<Reading>& readings) {
    for (const ClipDepths& clip : pixel.clip_depths()) add_clipped(pixel, sample, clip, readings);
    sort_out(readings);
    // In its plane the faces of a flat volume may come in any order, with the surface among them:
    // each one that is entered is left again, and in between the count is one more or less.
    const std::int64_t most = pixel.flat_volumes_around(sample);
    add_moved(pixel.counting(), -most, most, readings);
}

} // namespace shadowproof
