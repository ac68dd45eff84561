#include "compare/stencil/figures/volume_check.h"

#include "compare/stencil/figures/face_counts.h"
#include "compare/words.h"
#include "scenes/plan/plan.h"

#include <fmt/format.h>

#include <algorithm>

namespace shadowproof {

namespace {

/// The number of faces as the picture stores it.
std::uint64_t as_shown(std::int32_t faces) {
    return static_cast<std::uint64_t>(std::clamp(faces, 0, 255));
}

/// A picture of another size, or none, is wrong at every pixel.
void check_picture(const Frame& frame, const FaceCounts& counts, VolumeCheck& check) {
    const Image<std::uint8_t>& shown = frame.counted->volumes;
    check.checked = counts.low.pixels.size();
    const bool has_size = shown.width == counts.low.width && shown.height == counts.low.height;
    for (int y = 0; y < counts.low.height; ++y)
        for (int x = 0; x < counts.low.width; ++x) {
            const CheckedFigure faces{
                has_size ? shown.at(x, y) : std::uint64_t{0},
                {as_shown(counts.low.at(x, y)), as_shown(counts.high.at(x, y))}};
            if (has_size && faces.holds()) continue;
            if (check.unexplained++ == 0) check.first = WrongFaces{x, y, faces};
        }
}

/// What the technique draws that `auto` is measured against: everything, under the same light.
FigureRange fragments_of_the_whole(const Tracer& tracer, const Silhouette& silhouette, double far,
                                   const Frame& frame) {
    Frame whole;
    const Counting& counting = whole.counted.emplace().counting = {
        .dark_cap = make_plan(tracer.scene()).dark_cap, .flips = {.around_light = true}};
    const bool is_parallel = frame.depth_model.parallel; // without an infinite projection
    whole.depth_model = {.projection = is_parallel ? DepthModel::Projection::finite_reversed
                                                   : DepthModel::Projection::infinite_reversed,
                         .near = frame.depth_model.near,
                         .far = frame.depth_model.far,
                         .parallel = is_parallel,
                         .floating = true,
                         .eye_relative = true,
                         .subpixel_bits = frame.depth_model.subpixel_bits,
                         .front = is_parallel ? 0.5 : 0,
                         .clamp = is_parallel};
    const Volumes volumes(tracer, silhouette, counting);
    const DrawnFaces faces = drawn_faces(volumes, counting, whole.counted->volume_faces);
    return count_fragments({volumes.drawn_casters(), nullptr, faces, whole, far}, tracer.threads());
}

std::string range_words(const FigureRange& range) {
    return range.low == range.high
               ? grouped(range.low)
               : fmt::format("{} to {}", grouped(range.low), grouped(range.high));
}

std::string figure_words(std::string_view name, const CheckedFigure& figure) {
    return fmt::format("{} {} shown where {} predicted", name, grouped(figure.shown),
                       range_words(figure.predicted));
}

} // namespace

VolumeCheck check_volumes(const Tracer& tracer, const Silhouette& silhouette,
                          const Volumes& volumes, const Frame& frame, double far) {
    const DrawnFaces faces =
        drawn_faces(volumes, frame.counted->counting, frame.counted->volume_faces);
    const FaceCounts counts = count_faces(
        {volumes.drawn_casters(), volumes.far_ends(), faces, frame, far}, tracer.threads());
    VolumeCheck check;
    check.fragments = {frame.counted->volume_fragments, counts.fragments};
    check_picture(frame, counts, check);
    if (frame.counted->saved) {
        // The saving may be negative; a sum below zero is invalid.
        const std::int64_t shown = static_cast<std::int64_t>(frame.counted->volume_fragments) +
                                   frame.counted->saved->volume_fragments;
        check.against = CheckedFigure{static_cast<std::uint64_t>(shown),
                                      fragments_of_the_whole(tracer, silhouette, far, frame)};
    }
    return check;
}

std::string words_of(const VolumeCheck& check) {
    std::string words;
    const auto add = [&](const std::string& clause) {
        words += (words.empty() ? "" : "; ") + clause;
    };
    if (!check.fragments.holds()) add(figure_words("volume_fragments", check.fragments));
    if (check.against && !check.against->holds())
        add(figure_words("volume_fragments of the technique compared with", *check.against));
    if (check.first)
        add(fmt::format("picture of the volumes unexplained at {}, first ({},{}): {}",
                        counted(check.unexplained, "pixel"), check.first->x, check.first->y,
                        figure_words("faces", check.first->faces)));
    return words;
}

} // namespace shadowproof
