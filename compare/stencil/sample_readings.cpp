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

/// The sum of the faces that are counted with these clipping planes.
std::int64_t sum_with(const PixelFaces& pixel, const Sample& sample, const ClipDepths& clip) {
    return nominal_count(pixel.candidates(sample, clip), 0, 0, pixel.counting()).sum;
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
    std::int64_t by_near = pixel.cut_with_surfaces(sample);
    std::int64_t by_far = 0;
    if (clip.moved) {
        ClipDepths far_unmoved = pixel.clip_depths().front();
        const std::int64_t unmoved = sum_with(pixel, sample, far_unmoved);
        far_unmoved.near = clip.near;
        const std::int64_t moved_near = sum_with(pixel, sample, far_unmoved) - unmoved;
        by_near += moved_near;
        by_far = nominal.sum - start - last - unmoved - moved_near;
    }
    const auto add = [&](const CountOfSum& found) {
        const std::int64_t off = found.sum - nominal.sum;
        const bool by_depth = clip.moved || found != nominal;
        readings.push_back({.count = found.count,
                            .ideal = sample.ideal + off,
                            .in_cone = sample.in_cone,
                            .by_rounding = sample.moved || by_depth,
                            .by_depth = by_depth,
                            .by_planes = sample.by_planes,
                            .line = sample.line,
                            .depth = sample.depth,
                            .off_ray = off,
                            .by_near = by_near,
                            .by_far = by_far});
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
    add_moved(pixel.counting(), -most, most, true, readings);
}

} // namespace shadowproof
