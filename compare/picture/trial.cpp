#include "compare/picture/trial.h"

#include <algorithm>
#include <cmath>

namespace shadowproof {

namespace {

/// Regions of 16 x 16 pixels with wrong pixels, and as many without: 32,768 pixels. The value of a
/// parameter decides one outline, which passes most of the regions that have wrong pixels; with
/// sixty of them, a hundredth of its way across the picture is told apart. As many again would
/// double the time.
constexpr std::size_t most_patches = 64;

/// Whether the pixel lies within one class of a picture: next to others, half a pixel decides.
bool is_inside(const Image<Visibility>& picture, int x, int y) {
    const Visibility own = picture.at(x, y);
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, picture.height - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, picture.width - 1); ++u)
            if (picture.at(u, v) != own) return false;
    return true;
}

constexpr auto unexplained = static_cast<std::uint8_t>(Cause::unexplained);

} // namespace

Trial::Trial(const TracedScene& traced, const Frame& frame, const Image<std::uint8_t>& cause)
    : traced_(traced), frame_(frame), cause_(cause), picture_(traced.truth().visibility) {
    Image<std::uint8_t> wrong(cause.width, cause.height);
    for (std::size_t i = 0; i < cause.pixels.size(); ++i) {
        wrong.pixels[i] = cause.pixels[i] == unexplained ? 1 : 0;
        wrong_ += wrong.pixels[i];
    }
    std::uint64_t between = 0;
    for (int y = 0; y < cause.height; ++y)
        for (int x = 0; x < cause.width; ++x) {
            const float share = frame.pictured->lit_share.at(x, y);
            between += is_wrong(x, y) && share > 0.1F && share < 0.9F ? 1U : 0U;
        }
    is_soft_ = between * 20 > wrong_; // a few are chance
    sample_ = sampled_patches(wrong, frame.pictured->decided, most_patches);
    for (const Patch& patch : sample_)
        for_each_pixel(patch, [&](int x, int y) { sampled_wrong_ += wrong.at(x, y); });
    for_each_lightable(traced, sample_, [&](int x, int y) {
        const bool counts =
            is_wrong(x, y) || (is_right(x, y) && (!is_soft_ || is_inside(frame.claim, x, y)));
        sampled_pixels_.push_back({x, y, counts});
        sampled_points_.push_back(seen_point(traced, x, y));
    });
}

bool Trial::is_wrong(int x, int y) const {
    return cause_.at(x, y) == unexplained && frame_.pictured->decided.at(x, y) != 0;
}

bool Trial::is_right(int x, int y) const {
    return cause_.at(x, y) == no_difference && frame_.pictured->decided.at(x, y) != 0;
}

bool Trial::is_decidable(int x, int y) const {
    return (is_wrong(x, y) || is_right(x, y)) && may_be_lit(traced_, cause_.index(x, y));
}

Fit Trial::fit_in(std::span<const Patch> patches, const Predict& predict) {
    predict(patches, picture_);
    Fit fit;
    for (const Patch& patch : patches)
        for_each_pixel(patch, [&](int x, int y) {
            const bool as_claimed = picture_.at(x, y) == frame_.claim.at(x, y);
            if (is_wrong(x, y))
                fit.explained += as_claimed ? 1U : 0U;
            else if (!as_claimed && is_right(x, y) && is_inside(picture_, x, y))
                ++fit.contradicted;
        });
    for (const Patch& patch : patches)
        for_each_pixel(
            patch, [&](int x, int y) { picture_.at(x, y) = traced_.truth().visibility.at(x, y); });
    return fit;
}

Fit Trial::fit(const Predict& predict) {
    return fit_in(sample_, predict);
}

bool Trial::is_enough(std::uint64_t explained) const {
    return explained > 0 && explained * 20 >= sampled_wrong_;
}

void Trial::consider(std::string hypothesis, Parameters parameters, std::string words,
                     Predict predict, Settles settles) {
    const Fit found = fit(predict);
    if (found.score() <= 0 || !is_enough(static_cast<std::uint64_t>(found.score()))) return;
    considered_.push_back({{std::move(hypothesis), std::move(parameters), 0, 0, std::move(words)},
                           found,
                           std::move(predict),
                           settles});
}

void Trial::search(const Parametric& family, double from, double to) {
    constexpr int steps = 12;
    constexpr int refinements = 4;
    constexpr int bisections = 14;
    double best_value = from;
    double last_value = from; // up to which the score is the same
    std::int64_t best_score = 0;
    const auto look = [&](double value) {
        const Fit found = fit(family.predict(value));
        if (found.score() > best_score) {
            best_score = found.score();
            best_value = last_value = value;
        } else if (found.score() == best_score) {
            best_value = std::min(best_value, value);
            last_value = std::max(last_value, value);
        }
        return found;
    };
    const auto is_too_much = [](const Fit& fit) { return fit.contradicted > fit.explained; };
    double ratio = std::pow(to / from, 1.0 / steps);
    std::vector<Fit> fits;
    for (int i = 0; i <= steps; ++i) fits.push_back(look(from * std::pow(ratio, i)));
    for (int i = 0; i < steps; ++i) {
        const bool before = is_too_much(fits[static_cast<std::size_t>(i)]);
        if (before == is_too_much(fits[static_cast<std::size_t>(i) + 1])) continue;
        double low = from * std::pow(ratio, i);
        double high = low * ratio;
        for (int k = 0; k < bisections; ++k) {
            const double middle = std::sqrt(low * high);
            (is_too_much(look(middle)) == before ? low : high) = middle;
        }
    }
    for (int round = 0; round < refinements && best_score > 0; ++round) {
        ratio = std::pow(ratio, 1.0 / 3);
        const double middle = std::sqrt(best_value * last_value);
        for (const int step : {-2, -1, 1, 2}) look(middle * std::pow(ratio, step));
    }
    if (best_score <= 0) return;
    // The middle of what fits equally well.
    const double value = std::sqrt(best_value * last_value);
    Parameters parameters{{family.parameter, value}};
    parameters.insert(parameters.end(), family.also.begin(), family.also.end());
    consider(family.hypothesis, std::move(parameters), family.words(value), family.predict(value));
}

const Fit& Trial::whole_fit(Considered& each) {
    if (!each.whole)
        each.whole = fit_in(all_patches(picture_.width, picture_.height), each.predict);
    return *each.whole;
}

bool Trial::is_settled() {
    return std::any_of(considered_.begin(), considered_.end(), [&](Considered& each) {
        return each.settles == Settles::perhaps && each.fit.explained == sampled_wrong_ &&
               each.fit.contradicted == 0 && whole_fit(each).contradicted == 0;
    });
}

const Parameters* Trial::best_of(const std::string& hypothesis) const {
    const Considered* best = nullptr;
    for (const Considered& each : considered_)
        if (each.diagnosis.hypothesis == hypothesis &&
            (best == nullptr || each.fit.score() > best->fit.score()))
            best = &each;
    return best == nullptr ? nullptr : &best->diagnosis.parameters;
}

Diagnosed Trial::best(std::size_t most) {
    const auto sort = [&] {
        std::stable_sort(considered_.begin(), considered_.end(),
                         [](const Considered& a, const Considered& b) {
                             if (a.fit.score() != b.fit.score())
                                 return a.fit.score() > b.fit.score();
                             return a.settles < b.settles; // what is predicted before what is not
                         });
    };
    sort();
    if (considered_.size() > most) considered_.resize(most);
    for (Considered& each : considered_) {
        each.fit = whole_fit(each);
        each.diagnosis.explained = each.fit.explained;
        each.diagnosis.contradicted = each.fit.contradicted;
    }
    sort();
    std::erase_if(considered_, [](const Considered& each) { return each.fit.score() <= 0; });
    Diagnosed found;
    for (const Considered& each : considered_) found.hypotheses.push_back(each.diagnosis);
    if (!considered_.empty())
        considered_.front().predict(all_patches(picture_.width, picture_.height), picture_);
    found.left = Image<std::uint8_t>(picture_.width, picture_.height);
    for (int y = 0; y < picture_.height; ++y)
        for (int x = 0; x < picture_.width; ++x)
            found.left.at(x, y) =
                is_wrong(x, y) && picture_.at(x, y) != frame_.claim.at(x, y) ? 1 : 0;
    picture_ = traced_.truth().visibility;
    return found;
}

} // namespace shadowproof
