// What a technique's counter should read at each pixel. Where shadow depths alone tell it, they do;
// where it hangs on single faces (a cap left out, a counter that saturates), all faces on the
// pixel's eye ray are counted as the technique counts them.
#pragma once

#include "reference/volumes.h"
#include "scenes/frame.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace shadowproof {

/// A pixel's ray as a technique counts along it.
struct CountedRay {
    std::span<const Crossing> crossings; ///< by depth
    double surface = 0;                  ///< view depth of what is seen
    std::uint32_t seen = no_triangle;
    std::int32_t at_eye = 0; ///< shadow depths
    std::int32_t at_near = 0;
};

std::string_view name_of(Counting::Test test);           ///< "depth_pass"
std::string_view name_of(Counting::Operation operation); ///< "wrap"
std::string_view name_of(Counting::Start start);         ///< "near_plane"

/// What the counter holds before the first face.
std::int32_t start_of(const Counting& counting, std::int32_t at_eye, std::int32_t at_near);

/// A count moved on by so many equal steps: one that saturates stops at its limits, any other runs
/// on.
std::int64_t stepped(std::int64_t count, std::int64_t by, const Counting& counting);

/// A face that may be counted, or certainly is.
struct PossibleFace {
    Crossing face;
    bool certain = true;
};

/// All values of a counter that began with `start` after `faces`, in any order, and `dark_caps` at
/// infinity, drawn as they are: sides and caps, then the turned ones. A wrapping counter is left to
/// run on, and wraps where it is stored. In rising order; linear in faces times values.
std::vector<std::int64_t> possible_counts(std::vector<PossibleFace> faces, std::int64_t start,
                                          std::int64_t dark_caps, const Counting& counting);

/// Those of them where the same faces, counted without wrapping or stopping, add up to `sum`.
std::vector<std::int64_t> possible_counts_of_sum(std::vector<PossibleFace> faces,
                                                 std::int64_t start, std::int64_t dark_caps,
                                                 const Counting& counting, std::int64_t sum);

/// The one value where all faces are certain.
std::int64_t counted_in_order(const std::vector<Crossing>& faces, std::int64_t start,
                              std::int64_t dark_caps, const Counting& counting);

/// The counter after all faces along a ray.
std::int64_t counted(const CountedRay& ray, double far, const Counting& counting,
                     const DepthModel& depth_model);

class Prediction {
public:
    /// Keeps references to the first two.
    Prediction(const Tracer& tracer, const Silhouette& silhouette, const GroundTruth& truth,
               const ShadowDepths& depths, const Counting& counting, const DepthModel& depth_model);

    /// At the pixels' centres, before a wrapping counter has wrapped.
    const Image<std::int32_t>& counts() const { return counts_; }
    const Volumes& volumes() const { return volumes_; }
    /// Of the volumes that are counted, which may be cut off.
    const ShadowDepths& depths() const { return depths_; }
    /// Of those that the shadows ask for.
    const ShadowDepths& ideal_depths() const { return ideal_depths_ ? *ideal_depths_ : depths_; }

private:
    Volumes volumes_;
    ShadowDepths depths_;
    std::optional<ShadowDepths> ideal_depths_; ///< where they are not the same
    Image<std::int32_t> counts_;
};

} // namespace shadowproof
