#include "compare/classify.h"

#include "compare/judge/surface_check.h"
#include "compare/look_around.h"
#include "reference/parallel.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>
#include <vector>

namespace shadowproof {

namespace {

void record(Comparison& comparison, PixelPlace p, bool in_band) {
    EvidenceCheck& check = comparison.evidence;
    if (in_band) {
        ++check.in_band;
        return;
    }
    if (check.unexplained++ == 0 || std::pair(p.y, p.x) < std::pair(check.first_y, check.first_x)) {
        check.first_x = p.x;
        check.first_y = p.y;
    }
    comparison.evidence_miss.at(p.x, p.y) = 1;
}

void mark(Comparison& comparison, PixelPlace p, const PixelCause& cause) {
    comparison.cause.at(p.x, p.y) = static_cast<std::uint8_t>(cause.cause);
    if (cause.too_near) ++comparison.too_near;
    if (cause.also.empty()) return;
    if (comparison.also.pixels.empty())
        comparison.also = Image<std::uint32_t>(comparison.cause.width, comparison.cause.height);
    comparison.also.at(p.x, p.y) = cause.also.bits();
    ++comparison.several;
}

/// What the pixels' centres tell of a row.
struct SettledRow {
    std::vector<PixelPlace> open; ///< those that they do not settle
    std::vector<std::pair<PixelPlace, PixelCause>> causes;
};

std::vector<SettledRow> settle_rows(const Case& tried, int width, int height) {
    std::vector<SettledRow> rows(static_cast<std::size_t>(height));
    parallel_for(height, tried.tracer().threads(), [&](int y, int) {
        SettledRow& row = rows[static_cast<std::size_t>(y)];
        for (int x = 0; x < width; ++x) {
            const PixelPlace p{x, y};
            std::optional<PixelCause> cause;
            if (!tried.judge.settles(p, cause))
                row.open.push_back(p);
            else if (cause)
                row.causes.emplace_back(p, *cause);
        }
    });
    return rows;
}

/// Which of two causes to show first: unexplained, then any failing, then edge.
int urgency(Cause cause) {
    if (cause == Cause::unexplained) return 2;
    return cause == Cause::edge ? 0 : 1;
}

void count_causes(Comparison& comparison) {
    for (int y = 0; y < comparison.cause.height; ++y)
        for (int x = 0; x < comparison.cause.width; ++x) {
            const std::uint8_t value = comparison.cause.at(x, y);
            if (value == no_difference) continue;
            const auto cause = static_cast<Cause>(value);
            ++comparison.causes[value];
            ++comparison.differing;
            if (!comparison.first || urgency(cause) > urgency(comparison.first->cause))
                comparison.first = FirstDifference{x, y, cause};
        }
}

/// The surface shown is evidence, as a counter is: if no rasterizer would show it, nothing is
/// explained. `at_centre`: 1 where the evidence is that of the pixel's centre.
void check_surfaces(const Case& tried, const Image<std::uint8_t>& at_centre,
                    Comparison& comparison) {
    const SurfaceCheck check(tried.tracer(), tried.claim.frame, tried.claim.traced.far());
    const int width = comparison.evidence_miss.width;
    Image<std::uint8_t> wrong(width, comparison.evidence_miss.height);
    parallel_for(wrong.height, tried.tracer().threads(), [&](int y, int) {
        for (int x = 0; x < width; ++x) wrong.at(x, y) = check.holds(x, y) ? 0 : 1;
    });
    for (int y = 0; y < wrong.height; ++y)
        for (int x = 0; x < width; ++x)
            if (wrong.at(x, y) != 0 && comparison.evidence_miss.at(x, y) == 0) {
                --(at_centre.at(x, y) != 0 ? comparison.evidence.equal
                                           : comparison.evidence.in_band);
                record(comparison, {x, y}, false);
            }
}

/// A colour's verdict as a cause, if it has one.
std::optional<Cause> cause_of(ColorVerdict verdict) {
    if (verdict == ColorVerdict::beyond) return Cause::shading;
    if (verdict == ColorVerdict::moved) return Cause::edge;
    if (verdict == ColorVerdict::unexplained) return Cause::unexplained;
    return std::nullopt;
}

/// Colours differ if they are beyond their bounds; if surface or visibility differ, or are those of
/// the background, if they are not those of what is shown. A colour that is right for a place that
/// the rasterizer may have drawn instead is `edge`.
void check_colors(const Case& tried, Comparison& comparison) {
    const TracedScene& traced = tried.claim.traced;
    const Frame& frame = tried.claim.frame;
    // Of what does not filter they are told where they are known anyway.
    const PixelMeans* const means =
        filters(frame.color_model) ? &traced.pixel_means() : traced.known_pixel_means();
    comparison.colors =
        check_colors(tried.tracer(), traced.truth(), frame, traced.lights_before(), means);
    const Image<ColorVerdict>& verdicts = comparison.colors->verdict;
    for (int y = 0; y < verdicts.height; ++y)
        for (int x = 0; x < verdicts.width; ++x)
            if (const std::optional<Cause> cause = cause_of(verdicts.at(x, y)))
                comparison.cause.at(x, y) = static_cast<std::uint8_t>(*cause);
}

ShareFigures share_figures(const JudgedClaim& claim, const Image<std::uint8_t>& cause) {
    ShareFigures figures;
    for (std::size_t i = 0; i < cause.pixels.size(); ++i) {
        if (claim.frame.claim.pixels[i] == Visibility::partly_lit) ++figures.partly_lit;
        if (cause.pixels[i] != no_difference &&
            cause.pixels[i] != static_cast<std::uint8_t>(Cause::edge))
            figures.wrongness += wrongness(claim.traced.truth().visibility, claim.frame, i);
    }
    return figures;
}

} // namespace

double wrongness(const Image<Visibility>& truth, const Frame& frame, std::size_t pixel) {
    const Visibility right = truth.pixels[pixel];
    if (frame.claim.pixels[pixel] != Visibility::partly_lit || right == Visibility::background)
        return 1;
    const double light = lit_share(frame, pixel);
    return right == Visibility::lit ? 1 - light : light;
}

Comparison classify(const TracedScene& traced, const Frame& frame, const Judge& judge) {
    const int width = traced.truth().visibility.width;
    const int height = traced.truth().visibility.height;
    assert(frame.claim.width == width && frame.claim.height == height);
    const Case tried{{traced, frame}, judge};

    Comparison comparison;
    comparison.cause = Image<std::uint8_t>(width, height, no_difference);
    comparison.evidence_miss = Image<std::uint8_t>(width, height);
    comparison.evidence_name = judge.evidence();
    Image<std::uint8_t> at_centre(width, height, 1);
    std::vector<PixelPlace> open;
    for (const SettledRow& row : settle_rows(tried, width, height)) {
        for (const PixelPlace& p : row.open) at_centre.at(p.x, p.y) = 0;
        open.insert(open.end(), row.open.begin(), row.open.end());
        for (const auto& [p, cause] : row.causes) mark(comparison, p, cause);
    }
    comparison.evidence.equal = at_centre.pixels.size() - open.size();

    const std::vector<Finding> findings = look_around(tried, open);
    for (std::size_t i = 0; i < open.size(); ++i) {
        const PixelPlace p = open[i];
        record(comparison, p, findings[i].evidence_in_band);
        if (tried.claim.differs(p)) mark(comparison, p, findings[i].cause);
    }
    if (frame.shows_surface()) check_surfaces(tried, at_centre, comparison);
    if (!frame.color.pixels.empty()) check_colors(tried, comparison);
    if (!frame.share.pixels.empty())
        comparison.shares = share_figures(tried.claim, comparison.cause);
    comparison.summary = judge.summary(comparison.evidence, comparison.cause);
    count_causes(comparison);
    return comparison;
}

PixelFinding classify_pixel(const TracedScene& traced, const Frame& frame, const Judge& judge,
                            int x, int y) {
    const Case tried{{traced, frame}, judge};
    const PixelPlace p{x, y};
    PixelFinding found;
    std::optional<PixelCause> cause;
    if (!judge.settles(p, cause)) {
        std::vector<PixelPlace> places{p};
        const std::vector<Finding> findings = look_around(tried, places);
        found.unexplained = !findings.front().evidence_in_band;
        if (tried.claim.differs(p)) cause = findings.front().cause;
    }
    if (frame.shows_surface() && !SurfaceCheck(traced.tracer(), frame, traced.far()).holds(x, y))
        found.unexplained = true;
    if (!frame.color.pixels.empty())
        if (const auto of_color = cause_of(account_for_color(traced.tracer(), traced.truth(), frame,
                                                             x, y, traced.lights_before())
                                               .verdict))
            cause = PixelCause{*of_color, {}};
    if (!cause) return found;
    found.cause = static_cast<std::uint8_t>(cause->cause);
    found.also = cause->also;
    found.too_near = cause->too_near;
    return found;
}

} // namespace shadowproof
