// Judges one pixel's colour against the truth, over all places that the rasterizer may draw at the
// pixel.
#pragma once

#include "compare/color/color_check.h"
#include "compare/color/scrutiny.h"
#include "compare/driver/interpolated.h"
#include "compare/driver/lighting/color_terms.h"
#include "compare/driver/lighting/lighting_arithmetic.h"
#include "compare/driver/lighting/lighting_inputs.h"
#include "compare/driver/setup_error.h"
#include "reference/trace/trace.h"
#include "scenes/frame.h"

#include <cstdint>
#include <span>
#include <vector>

namespace shadowproof {

/// A verdict and the limits behind it. Each limit holds the colours of all places that the
/// rasterizer may draw, and others between them; the verdict tests place by place.
struct ColorJudgement {
    ColorVerdict verdict = ColorVerdict::as_shown;
    Intervals bound;     ///< colours that count as right
    Intervals predicted; ///< colours that the technique's arithmetic may give
    PixelSpread spread;
};

/// Judges the colours of one frame, which adds up the light of its scene's chosen light and of
/// those before it.
class ColorJudge {
public:
    /// `before`: as many lights as the frame has. `means`: not null where its model filters.
    ColorJudge(const Tracer& tracer, const GroundTruth& truth, const TracedLights& before,
               const Frame& frame, const PixelMeans* means);

    /// Whether surface and visibility under each light are the truth's.
    bool is_as_true(int x, int y) const;
    bool shows_background(int x, int y) const { return shown(x, y) == no_triangle; }
    glm::dvec3 claim(int x, int y) const { return frame_.color.at(x, y); }
    /// The ray through the pixel's centre, or `beside` it by so many pixels.
    glm::dvec3 line(int x, int y, const glm::dvec2& beside = {0, 0}) const;
    /// Appends what the technique shows through the pixel's centre, one point per light, the chosen
    /// one last.
    void append_points(int x, int y, std::vector<SeenPoint>& points) const;

    /// `shadings`: of these points.
    ColorJudgement judged(int x, int y, std::span<const Shading> shadings, Scrutiny scrutiny) const;
    /// The background is what was cleared: no rounding, nothing beside it.
    ColorVerdict judged_background(int x, int y) const;

    /// The colour that is right, as the frame can show it: of the pixel's centre, where the ray's
    /// colour is given; of all of it, where the frame's model filters.
    glm::dvec3 right_color(int x, int y, const glm::dvec3& at_centre) const;

    /// How far each ColorTerm moves the colour of a pixel that shows the triangle.
    ColorTerms weights(int x, int y, std::span<const Shading> shadings, std::uint32_t triangle,
                       const PixelSpread& spread) const;

private:
    /// A square of the picture around a pixel's centre, in pixels.
    struct Square {
        glm::dvec2 middle{0, 0};
        double half = 0;
    };
    struct PixelPlace {
        int x = 0;
        int y = 0;
        std::span<const Shading> shadings; ///< one per light
        std::uint32_t triangle = 0;
        /// The same as they may be drawn besides, if lights are claimed to be dark of whose cones
        /// the pixel may lie at the edge: each of a technique's draws finds that by itself.
        std::span<const std::vector<Shading>> at_cones{};
        /// As QuadRays has them, where the model filters: of all that the rasterizer may draw.
        double quad_share = 0;
        double quad_stretch = 0;

        const Shading& own() const { return shadings.back(); }
    };
    /// A light whose light is added up: what is true and what is claimed.
    struct AddedLight {
        const Tracer& tracer;
        const Scene& scene; ///< with it chosen
        const GroundTruth& truth;
        const Image<Visibility>& claim;
    };

    const Tracer& tracer_;
    const Scene& scene_;
    const GroundTruth& truth_;
    const Frame& frame_;
    const PixelMeans* means_;        ///< null where the model does not filter
    std::vector<AddedLight> lights_; ///< the chosen one last
    LightingTables tables_;

    std::uint32_t shown(int x, int y) const { return frame_.triangle.at(x, y); }
    double depth(int x, int y) const;
    ColorJudgement judged_as_shown(PixelPlace pixel, Scrutiny scrutiny) const;
    /// The result of `of` for the inputs of each light.
    template <class Of>
    auto of_lights(std::span<const Shading> shadings, std::uint32_t triangle,
                   const PixelSpread& spread, const Of& of) const;
    std::vector<std::vector<Shading>> shadings_at_cones(const PixelPlace& pixel) const;
    /// One interval for each choice of lights at whose cones' edges the pixel lies.
    std::vector<Intervals> bounds(const PixelPlace& pixel, const PixelSpread& spread) const;
    /// One interval for each choice that the technique may have made (footprint_choices).
    std::vector<Intervals> predicted(const PixelPlace& pixel, const PixelSpread& spread) const;
    double lateral(int x, int y) const;
    DrawnAttribute drawn(int x, int y, const glm::dvec2& beside = {0, 0}) const;
    void find_quad_errors(PixelPlace& pixel, double share) const;
    void add_quad(const PixelPlace& pixel, const Square& square, PixelSpread& spread) const;
    double facing(std::uint32_t triangle, const glm::dvec3& line) const;
    PixelSpread over(const PixelPlace& pixel, const Square& square, double share) const;
    template <class Limit>
    bool somewhere(const PixelPlace& pixel, const Square& square, double share, int halvings,
                   const Limit& limit) const;
    ColorJudgement judged_aside(const PixelPlace& pixel, const DrawnAttribute& drawn, bool right,
                                bool is_predicted) const;
};

} // namespace shadowproof
