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
        pixel.inverse_depth = inverse_depth(frame.depth_model, frame.depth.at(x, y));
    else if (frame.depth_model.finite())
        pixel.inverse_depth = 1 / far;
    return pixel;
}

Chance covers(const PicturedFace& face, const ShownPixel& pixel) {
    const bool certain = face.certain.holds(pixel.centre);
    return {certain || face.possible.holds(pixel.centre), certain};
}

// A depth's error is the largest of the parts that may cover the pixel.
InverseDepths inverse_depths_of(const PicturedFace& face, const ShownPixel& pixel,
                                const WindowRoundings& roundings) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (face.edge_on) return {-infinity, infinity};
    const double inverse = face.inverse_depth.x * pixel.centre.x +
                           face.inverse_depth.y * pixel.centre.y + face.inverse_depth.z;
    double error = 0;
    for (const DepthError& part : face.parts)
        if (part.part.holds(pixel.centre)) error = std::max(error, part.error);
    error += roundings.constant + roundings.share * std::abs(inverse);
    if (!(error < infinity)) return {-infinity, infinity};
    return {inverse - error, inverse + error};
}

Chance is_in_front(const InverseDepths& depths, const ShownPixel& pixel) {
    return {depths.high >= pixel.inverse_depth, depths.low > pixel.inverse_depth};
}

bool is_coarse(const PicturedFace& face, const Chance& covered, const ShownPixel& pixel) {
    return covered.possible && !covered.certain && face.margin > 2 * pixel.reach;
}

namespace {

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

    void add(std::uint32_t triangle, std::span<const ShownPixel> pixels,
             std::vector<SurfaceChance>& chances) const {
        const auto at = [&](int k) { return glm::dvec4(corner(scene_, triangle, k), 1); };
        const PicturedFace face = pictured_face(making_, {at(0), at(1), at(2)}, nullptr, 0);
        // A sliver may come out either way round.
        const bool drawn = sides_of(tracer_, triangle).visible;
        const bool certainly_drawn = drawn && (face.change != 0 || is_double_sided(triangle));
        const bool maybe_drawn = drawn || face.change == 0;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const Chance covered = covers(face, pixels[i]);
            SurfaceChance& chance = chances[i];
            if (triangle == pixels[i].triangle) {
                chance.may_be_seen = chance.may_be_seen && covered.possible;
            } else if (covered.possible && maybe_drawn) {
                const Chance front =
                    is_in_front(inverse_depths_of(face, pixels[i], roundings_), pixels[i]);
                if (front.certain && covered.certain && certainly_drawn) chance.may_be_seen = false;
                if (front.possible && !front.certain) chance.tied.push_back(triangle);
            }
            if (maybe_drawn && is_coarse(face, covered, pixels[i])) chance.is_coarse = true;
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
    const std::size_t count = tracer.scene().triangles.size();
    std::vector<SurfaceChance> chances(pixels.size());
    constexpr std::size_t together = 256;
    std::mutex mutex;
    parallel_for(static_cast<int>((count + together - 1) / together), tracer.threads(),
                 [&](int piece, int) {
                     std::vector<SurfaceChance> found(pixels.size());
                     const std::size_t begin = static_cast<std::size_t>(piece) * together;
                     for (std::size_t i = begin; i < std::min(begin + together, count); ++i)
                         triangles.add(static_cast<std::uint32_t>(i), pixels, found);
                     const std::lock_guard lock(mutex);
                     for (std::size_t i = 0; i < pixels.size(); ++i) {
                         chances[i].is_coarse = chances[i].is_coarse || found[i].is_coarse;
                         chances[i].may_be_seen = chances[i].may_be_seen && found[i].may_be_seen;
                         chances[i].tied.insert(chances[i].tied.end(), found[i].tied.begin(),
                                                found[i].tied.end());
                     }
                 });
    return chances;
}

} // namespace shadowproof
