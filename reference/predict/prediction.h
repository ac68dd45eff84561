// Predicts what a technique's counter reads at each pixel. Shadow depths are used where they
// suffice; where the counter depends on single faces (a cap left out, a counter that saturates),
// all faces on the pixel's eye ray are counted as the technique counts them.
#pragma once

#include "reference/predict/limitation.h"
#include "reference/predict/volume_store.h"
#include "scenes/frame.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace shadowproof {

/// A pixel's ray as a technique counts along it.
struct CountedRay {
    std::span<const Crossing> crossings; ///< by depth
    double surface = 0;                  ///< view depth of the visible surface
    std::uint32_t seen = no_triangle;
    std::int32_t at_eye = 0; ///< shadow depths
    std::int32_t at_near = 0;
};

std::string_view name_of(Counting::Test test);           ///< "depth_pass"
std::string_view name_of(Counting::Operation operation); ///< "wrap"
std::string_view name_of(Counting::Start start);         ///< "near_plane"

/// What the counter holds before the first face.
std::int32_t start_of(const Counting& counting, std::int32_t at_eye, std::int32_t at_near);

/// A count after steps that add up to `by`, all in one direction. One that saturates stops at its
/// limits, any other continues.
std::int64_t stepped(std::int64_t count, std::int64_t by, const Counting& counting);

/// A face that may be counted, or certainly is.
struct PossibleFace {
    Crossing face;
    bool certain = true;
};

/// All values that a counter may have: it starts with `start`, counts `faces`, in any order, and
/// `dark_caps` at infinity. They are drawn as techniques do: sides and caps, then the flipped
/// faces; but see Counting::caps_first. A wrapping counter is not wrapped here, but where it is
/// stored. In ascending order; takes time linear in faces times values.
std::vector<std::int64_t> possible_counts(std::vector<PossibleFace> faces, std::int64_t start,
                                          std::int64_t dark_caps, const Counting& counting);

/// A value of a counter, and the sum of the same faces without wrapping or stopping.
struct CountOfSum {
    std::int64_t sum = 0;
    std::int64_t count = 0;
    friend auto operator<=>(const CountOfSum&, const CountOfSum&) = default;
};

/// All pairs of them, in ascending order.
std::vector<CountOfSum> possible_sums(std::vector<PossibleFace> faces, std::int64_t start,
                                      std::int64_t dark_caps, const Counting& counting);

/// The counts for which the same faces have the sum `sum`.
std::vector<std::int64_t> possible_counts_of_sum(std::vector<PossibleFace> faces,
                                                 std::int64_t start, std::int64_t dark_caps,
                                                 const Counting& counting, std::int64_t sum);

/// The one value where all faces are certain.
std::int64_t counted_in_order(const std::vector<Crossing>& faces, std::int64_t start,
                              std::int64_t dark_caps, const Counting& counting);

/// The counter after all faces along a ray.
std::int64_t counted(const CountedRay& ray, double far, const Counting& counting,
                     const DepthModel& depth_model);

/// A surface point that a ray beside a pixel's centre meets.
struct SurfaceRay {
    glm::dvec3 line{0, 0, 0};
    double depth = 0; ///< view depth of the surface
    std::uint32_t seen = no_triangle;
    std::array<glm::dvec3, 4> corners{}; ///< of a rectangle around it, as RegionLedger takes them
};

class Prediction {
public:
    /// Keeps a reference to the store.
    Prediction(const VolumeStore& store, const Counting& counting, const DepthModel& depth_model);
    ~Prediction();
    Prediction(Prediction&&) noexcept;
    Prediction& operator=(Prediction&&) noexcept = delete;
    Prediction(const Prediction&) = delete;
    Prediction& operator=(const Prediction&) = delete;

    /// The counter at the pixels' centres, before a wrapping counter has wrapped.
    const Image<std::int32_t>& counts() const { return counts_; }

    /// The technique's limitations.
    Limitations limitations() const;
    /// How the technique would count without some of them.
    const CountingModel& without(Limitations limitations) const;
    /// What its counter would then be at a pixel's centre, before a wrapping counter has wrapped.
    /// Volumes other than the technique's own are made on first use. Without Limitation::alpha, the
    /// volumes that masks let the light through are not counted. May be called by any thread.
    std::int64_t count_without(Limitations limitations, int x, int y) const;
    /// The same where a ray meets a surface, by crossings computed in double. Light caps in
    /// surfaces in front of it count as behind it, since what is seen through those surfaces is
    /// seen through their caps.
    std::int64_t count_without(Limitations limitations, const SurfaceRay& ray) const;

    const Volumes& volumes() const { return own_->volumes; }
    /// What masks let through at a pixel's centre (count_let_through).
    std::int32_t let_through(int x, int y) const {
        const Image<std::int32_t>& open = *own_->let_through;
        return open.pixels.empty() ? 0 : open.at(x, y);
    }
    /// Shadow depths in the volumes that are counted, which may be cut off.
    const ShadowDepths& depths() const { return *own_->depths; }
    /// Shadow depths in the volumes that give the right shadows (Volumes::are_ideal).
    const ShadowDepths& ideal_depths() const { return *own_->ideal_depths; }

private:
    struct Cache;

    const VolumeStore* store_;
    CountingModel model_;
    std::shared_ptr<const CountedVolumes> own_;
    Image<std::int32_t> counts_;
    std::unique_ptr<Cache> cache_;

    Image<std::int32_t> count_all(const CountedVolumes& counted, const CountingModel& model) const;
    /// The volumes without these limitations. The cache must be locked.
    const CountedVolumes& lifted(Limitations limitations) const;
    const CountedVolumes& volumes_without(Limitations limitations) const;
    std::int64_t count_with_masks(Limitations limitations, int x, int y) const;
    std::int64_t count_with_masks(Limitations limitations, const SurfaceRay& ray) const;
};

} // namespace shadowproof
