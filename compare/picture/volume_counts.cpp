#include "compare/picture/volume_counts.h"

#include "reference/parallel.h"
#include "reference/predict/prediction.h"
#include "reference/predict/volumes.h"
#include "reference/trace/faces.h"
#include "scenes/camera.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>

namespace shadowproof {

namespace {

/// A pixel whose surface faces the light, and the faces that its ray crosses.
struct CrossedPixel {
    int x = 0;
    int y = 0;
    double surface = 0;
    std::uint32_t seen = no_triangle;
    std::vector<Crossing> crossings{};
};

/// The same eye and light with a picture of one pixel: volumes and the counts around the eye are
/// those of the scene, and next to nothing is traced for them.
Scene one_pixel(Scene scene) {
    scene.camera.width = 1;
    scene.camera.height = 1;
    return scene;
}

/// Volumes, and how many of them hold the eye.
struct Made {
    Counting counting{};
    std::optional<Volumes> volumes{};
    std::int32_t at_eye = 0;

    bool are_of(const Counting& other) const {
        return volumes && counting.flips == other.flips && counting.extrusion == other.extrusion &&
               counting.holes_filled == other.holes_filled;
    }
};

} // namespace

struct VolumeCounts::State {
    const TracedScene& traced;
    Scene probe;
    Tracer tracer;
    GroundTruth truth;
    TracedScene probed;
    Made made{};
    /// Of the patches that were counted last, if they are few.
    std::vector<Patch> crossed_patches{};
    std::vector<std::vector<CrossedPixel>> crossed{};

    explicit State(const TracedScene& given)
        : traced(given), probe(one_pixel(given.scene())), tracer(probe, given.tracer().threads()),
          truth(trace(tracer)), probed(tracer, truth) {}

    void make(const Counting& counting) {
        if (made.are_of(counting)) return;
        crossed_patches.clear();
        made.counting = counting;
        made.volumes.reset();
        made.volumes.emplace(tracer, probed.silhouette(), counting);
        made.at_eye = made.volumes->shadow_depths(truth, probed.depths()).at_eye;
    }

    std::vector<CrossedPixel> cross(const Patch& patch) const {
        const Scene& scene = traced.scene();
        const Camera& camera = scene.camera;
        RegionLedger ledger = made.volumes->ledger(
            corner_lines(camera, patch.left, patch.top, patch.right, patch.bottom));
        std::vector<CrossedPixel> pixels;
        for_each_pixel(patch, [&](int x, int y) {
            const std::uint32_t seen = traced.truth().triangle.at(x, y);
            if (seen == no_triangle || !sides_of(traced.tracer(), seen).faces_light()) return;
            const glm::dvec3 direction = line_of_sight(camera, x + 0.5, y + 0.5);
            CrossedPixel& pixel = pixels.emplace_back(
                CrossedPixel{x, y, depth_on_triangle(scene, seen, direction), seen});
            ledger.crossings(direction, pixel.crossings);
        });
        return pixels;
    }

    Visibility class_of(const CrossedPixel& pixel, const Counting& counting,
                        const DepthModel& model, double far) const {
        if (pixel.surface < model.near) return Visibility::background;
        std::int32_t at_near = made.at_eye;
        for (const Crossing& crossing : pixel.crossings)
            if (crossing.depth < model.near) at_near += crossing.change;
        const std::int64_t count =
            counted({pixel.crossings, pixel.surface, pixel.seen, made.at_eye, at_near}, far,
                    counting, model);
        const Image<std::uint8_t>& cone = traced.truth().in_cone;
        const bool in_cone = cone.pixels.empty() || cone.at(pixel.x, pixel.y) != 0;
        return stored(count, counting) == 0 && in_cone ? Visibility::lit : Visibility::shadowed;
    }

    /// Kept for the next call, where they are few.
    bool keep(std::span<const Patch> patches) {
        constexpr std::size_t most_kept = 256; // patches of 256 pixels: some megabytes
        const auto same = [](const Patch& a, const Patch& b) {
            return a.left == b.left && a.top == b.top && a.right == b.right && a.bottom == b.bottom;
        };
        if (patches.size() > most_kept) return false;
        if (std::equal(patches.begin(), patches.end(), crossed_patches.begin(),
                       crossed_patches.end(), same))
            return true;
        crossed_patches.assign(patches.begin(), patches.end());
        crossed.assign(patches.size(), {});
        parallel_for(static_cast<int>(patches.size()), tracer.threads(), [&](int i, int) {
            crossed[static_cast<std::size_t>(i)] = cross(patches[static_cast<std::size_t>(i)]);
        });
        return true;
    }

    void predict(const Counting& counting, const DepthModel& model, double far,
                 std::span<const Patch> patches, Image<Visibility>& picture) {
        make(counting);
        const bool kept = keep(patches);
        parallel_for(static_cast<int>(patches.size()), tracer.threads(), [&](int i, int) {
            const auto place = static_cast<std::size_t>(i);
            std::vector<CrossedPixel> own;
            if (!kept) own = cross(patches[place]);
            for (const CrossedPixel& pixel : kept ? crossed[place] : own)
                picture.at(pixel.x, pixel.y) = class_of(pixel, counting, model, far);
        });
    }
};

VolumeCounts::VolumeCounts(const TracedScene& traced) : state_(std::make_unique<State>(traced)) {}
VolumeCounts::~VolumeCounts() = default;

Predict VolumeCounts::predict(const Counting& counting, const DepthModel& model, double far) const {
    return [state = state_.get(), counting, model, far](std::span<const Patch> patches,
                                                        Image<Visibility>& picture) {
        state->predict(counting, model, far, patches, picture);
    };
}

} // namespace shadowproof
