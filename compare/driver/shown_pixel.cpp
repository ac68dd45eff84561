#include "compare/driver/shown_pixel.h"

#include "reference/parallel.h"
#include "scenes/driver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

namespace shadowproof {

ShownPixel shown_pixel(const Frame& frame, double far, int x, int y, double reach) {
    ShownPixel pixel{{x + 0.5, y + 0.5}, reach, frame.triangle.at(x, y), 0};
    if (pixel.triangle != no_triangle)
        pixel.nearness = nearness_of_window(frame.depth_model, frame.depth.at(x, y));
    else if (frame.depth_model.background_at_far())
        pixel.nearness = nearness_of_depth(frame.depth_model, far);
    else if (frame.depth_model.parallel)
        pixel.nearness = -std::numeric_limits<double>::infinity();
    return pixel;
}

PixelsByRow::PixelsByRow(std::span<const ShownPixel> pixels, int height)
    : numbers_(pixels.size()), first_(static_cast<std::size_t>(height) + 1, 0) {
    const auto row = [&](std::size_t i) { return static_cast<std::size_t>(pixels[i].centre.y); };
    for (std::size_t i = 0; i < pixels.size(); ++i) ++first_[row(i) + 1];
    for (std::size_t y = 1; y < first_.size(); ++y) first_[y] += first_[y - 1];
    std::vector<std::size_t> next(first_);
    for (std::size_t i = 0; i < pixels.size(); ++i) numbers_[next[row(i)]++] = i;
}

PixelRun PixelsByRow::rows_of(const PicturedFace& face) const {
    const int height = static_cast<int>(first_.size()) - 1;
    return either(face.possible.rows(height), face.certain_of_both.rows(height));
}

std::span<const std::size_t> PixelsByRow::within(const PixelRun& rows) const {
    if (rows.length() == 0) return {};
    const std::size_t begin = first_[static_cast<std::size_t>(rows.first)];
    const std::size_t end = first_[static_cast<std::size_t>(rows.end)];
    return std::span(numbers_).subspan(begin, end - begin);
}

Chance covers(const PicturedFace& face, const ShownPixel& pixel) {
    const bool certain = face.certain.holds(pixel.centre);
    return {certain || face.possible.holds(pixel.centre), certain};
}

// A depth's error is the largest of the parts that may cover the pixel.
NearnessRange nearness_of(const PicturedFace& face, const ShownPixel& pixel,
                          const WindowRoundings& roundings) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (face.edge_on) return {-infinity, infinity};
    const double nearness =
        face.nearness.x * pixel.centre.x + face.nearness.y * pixel.centre.y + face.nearness.z;
    double error = 0;
    for (const DepthError& part : face.parts)
        if (part.part.holds(pixel.centre)) error = std::max(error, part.error);
    error += roundings.constant + roundings.share * std::abs(nearness);
    if (!(error < infinity)) return {-infinity, infinity};
    return {nearness - error, nearness + error};
}

Chance is_in_front(const NearnessRange& range, const ShownPixel& pixel) {
    return {range.high >= pixel.nearness, range.low > pixel.nearness};
}

bool is_coarse(const PicturedFace& face, const Chance& covered, const ShownPixel& pixel) {
    return covered.possible && !covered.certain && face.margin > 2 * pixel.reach;
}

namespace {

/// What triangles do to a pixel.
struct Seen {
    bool is_coarse = false;
    bool covered = false; ///< by the triangle that is shown, perhaps
    bool hidden = false;  ///< certainly
    std::vector<std::uint32_t> tied{};

    void add(const Seen& other) {
        is_coarse = is_coarse || other.is_coarse;
        covered = covered || other.covered;
        hidden = hidden || other.hidden;
        tied.insert(tied.end(), other.tied.begin(), other.tied.end());
    }
};

class SeenTriangles {
public:
    SeenTriangles(const Tracer& tracer, const Frame& frame)
        : tracer_(tracer),
          scene_(tracer.scene()), making_{scene_.camera,
                                          drawing_of(scene_, frame.depth_model, scene_.camera.far),
                                          half_snapping_step(frame.depth_model.subpixel_bits)},
          roundings_(window_roundings(frame.depth_model)) {
        making_.drawing.near = scene_.camera.near; // nowhere are surfaces' depths clamped
    }

    void add(std::uint32_t triangle, std::span<const ShownPixel> pixels, const PixelsByRow& by_row,
             std::vector<Seen>& found) const {
        const auto at = [&](int k) { return glm::dvec4(corner(scene_, triangle, k), 1); };
        const PicturedFace face = pictured_face(making_, {at(0), at(1), at(2)}, nullptr, 0);
        // A sliver may come out either way round.
        const bool drawn = sides_of(tracer_, triangle).visible;
        // Through the holes of its mask others are seen.
        const bool certainly_drawn =
            drawn && !has_mask(scene_, triangle) && (face.change != 0 || is_double_sided(triangle));
        const bool maybe_drawn = drawn || face.change == 0;
        for (const std::size_t i : by_row.within(by_row.rows_of(face))) {
            const Chance covered = covers(face, pixels[i]);
            Seen& seen = found[i];
            if (triangle == pixels[i].triangle) {
                seen.covered = covered.possible;
            } else if (covered.possible && maybe_drawn) {
                const Chance front =
                    is_in_front(nearness_of(face, pixels[i], roundings_), pixels[i]);
                if (front.certain && covered.certain && certainly_drawn) seen.hidden = true;
                if (front.possible && !front.certain) seen.tied.push_back(triangle);
            }
            if (maybe_drawn && is_coarse(face, covered, pixels[i])) seen.is_coarse = true;
        }
    }

private:
    const Tracer& tracer_;
    const Scene& scene_;
    PictureMaking making_;
    WindowRoundings roundings_;

    bool is_double_sided(std::uint32_t triangle) const {
        return scene_.materials[scene_.meshes[mesh_of(scene_, triangle)].material].double_sided;
    }
};

} // namespace

std::vector<SurfaceChance> surface_chances(const Tracer& tracer, const Frame& frame,
                                           std::span<const ShownPixel> pixels) {
    const SeenTriangles triangles(tracer, frame);
    const PixelsByRow by_row(pixels, tracer.scene().camera.height);
    const std::size_t count = tracer.scene().triangles.size();
    std::vector<Seen> seen(pixels.size());
    constexpr std::size_t together = 256;
    std::mutex mutex;
    parallel_for(static_cast<int>((count + together - 1) / together), tracer.threads(),
                 [&](int piece, int) {
                     std::vector<Seen> found(pixels.size());
                     const std::size_t begin = static_cast<std::size_t>(piece) * together;
                     for (std::size_t i = begin; i < std::min(begin + together, count); ++i)
                         triangles.add(static_cast<std::uint32_t>(i), pixels, by_row, found);
                     const std::lock_guard lock(mutex);
                     for (std::size_t i = 0; i < pixels.size(); ++i) seen[i].add(found[i]);
                 });
    std::vector<SurfaceChance> chances;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const bool covered = pixels[i].triangle == no_triangle || seen[i].covered;
        chances.push_back({seen[i].is_coarse, covered && !seen[i].hidden, seen[i].tied});
    }
    return chances;
}

} // namespace shadowproof
