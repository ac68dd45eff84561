// Hypotheses about a picture's wrong pixels, ranked by what they explain and what they contradict.
#pragma once

#include "compare/picture/diagnosis.h"
#include "compare/picture/predict.h"

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace shadowproof {

using Parameters = std::vector<std::pair<std::string, double>>;

/// How well a predicted picture fits.
struct Fit {
    std::uint64_t explained = 0;    ///< wrong pixels that it predicts
    std::uint64_t contradicted = 0; ///< right pixels that it predicts to be wrong
    std::int64_t score() const {
        return static_cast<std::int64_t>(explained) - static_cast<std::int64_t>(contradicted);
    }
};

/// A hypothesis at each value of its parameter.
struct Parametric {
    std::string hypothesis;
    std::string parameter;
    std::function<Predict(double)> predict;
    std::function<std::string(double)> words;
    Parameters also{}; ///< told beside it
};

/// Whether the search may end with a hypothesis that explains everything.
enum class Settles : std::uint8_t {
    perhaps,
    never, ///< it explains what it does not predict: another one may say why
};

struct SampledPixel {
    int x = 0;
    int y = 0;
    /// Wrong or right; but of soft shadows, of which an outline is known to a pixel, not what is
    /// right next to one.
    bool counts = false;
};

class Trial {
public:
    /// Keeps references; `cause`: Comparison::cause.
    Trial(const TracedScene& traced, const Frame& frame, const Image<std::uint8_t>& cause);

    const TracedScene& traced() const { return traced_; }
    const Scene& scene() const { return traced_.scene(); }
    const GroundTruth& truth() const { return traced_.truth(); }
    const Frame& frame() const { return frame_; }
    std::uint64_t wrong() const { return wrong_; }
    std::uint64_t sampled_wrong() const { return sampled_wrong_; }
    bool is_wrong(int x, int y) const;
    bool is_right(int x, int y) const; ///< decided, and no difference
    /// Right or wrong, and not dark whatever the shadows are.
    bool is_decidable(int x, int y) const;
    /// Whether some wrong pixels lie between light and shadow.
    bool is_soft() const { return is_soft_; }
    /// Where hypotheses are compared before the best are predicted for the whole picture.
    const std::vector<Patch>& sample() const { return sample_; }
    /// Its pixels that may_be_lit, in order, and the points that they see.
    const std::vector<SampledPixel>& sampled_pixels() const { return sampled_pixels_; }
    const std::vector<glm::dvec3>& sampled_points() const { return sampled_points_; }

    /// On the sample.
    Fit fit(const Predict& predict);
    /// Whether so many wrong pixels of the sample are a twentieth of them: less is chance.
    bool is_enough(std::uint64_t explained) const;
    /// Adds the hypothesis if it explains enough of the sample's wrong pixels more than it
    /// contradicts.
    void consider(std::string hypothesis, Parameters parameters, std::string words, Predict predict,
                  Settles settles = Settles::perhaps);
    /// Considers the best value of a parameter between two, which are positive. They are tried in
    /// equal ratios, then more finely around the best. Where too much is wrong by one value and
    /// nothing by the next, the right one lies in between, and is found by bisection.
    void search(const Parametric& family, double from, double to);

    /// Whether some hypothesis explains all of the sample and contradicts nothing of the whole
    /// picture: then no other need be tried.
    bool is_settled();
    /// The parameters of the best hypothesis so far by that name; null where there is none.
    const Parameters* best_of(const std::string& hypothesis) const;
    /// The best, by the whole picture, and the wrong pixels that the first of them leaves.
    Diagnosed best(std::size_t most);

private:
    struct Considered {
        Diagnosis diagnosis;
        Fit fit; ///< on the sample
        Predict predict;
        Settles settles = Settles::perhaps;
        std::optional<Fit> whole{}; ///< on the whole picture, once it was asked
    };

    const TracedScene& traced_;
    const Frame& frame_;
    const Image<std::uint8_t>& cause_;
    std::uint64_t wrong_ = 0;
    std::uint64_t sampled_wrong_ = 0;
    bool is_soft_ = false;
    std::vector<Patch> sample_;
    std::vector<SampledPixel> sampled_pixels_;
    std::vector<glm::dvec3> sampled_points_;
    Image<Visibility> picture_; ///< the truth, but while something is predicted
    std::vector<Considered> considered_;

    Fit fit_in(std::span<const Patch> patches, const Predict& predict);
    const Fit& whole_fit(Considered& each);
};

} // namespace shadowproof
