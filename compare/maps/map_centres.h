// What a map says at the pixels' centres: the texels that they ask, each judged as it is traced,
// the answers, and why the wrong ones are wrong.
#pragma once

#include "compare/judge/judge.h"
#include "compare/maps/lookup.h"
#include "compare/maps/map_cause.h"
#include "compare/maps/map_report.h"
#include "compare/maps/texel_set.h"

#include <atomic>
#include <optional>
#include <vector>

namespace shadowproof {

/// Made on all threads; then asked from many at once. Keeps references to claim and light.
class MapCentres {
public:
    MapCentres(const JudgedClaim& claim, const LightView& light);
    MapCentres(const MapCentres&) = delete;
    MapCentres& operator=(const MapCentres&) = delete;

    /// Judge::settles.
    bool settles(PixelPlace p, std::optional<PixelCause>& cause) const;

    /// How many texels pixels' centres ask, and how many of them no rasterizer would store.
    std::size_t texels() const { return texels_.size(); }
    std::size_t texels_not_shown() const { return not_shown_; }

    /// LightView::shown of a texel, whether or not a centre asks it.
    std::optional<std::uint32_t> shown_by(const Texel& texel) const;
    /// What it holds exactly.
    LightView::Shown held_by(const Texel& texel) const;

    /// What the pixel's centre looks up; nothing where it asks no texel.
    std::optional<PixelLookup> lookup_at(PixelPlace p) const;

    /// Of the pixel's centre (line_of_sight).
    glm::dvec3 line_at(PixelPlace p) const {
        return columns_[static_cast<std::size_t>(p.x)] + rows_[static_cast<std::size_t>(p.y)];
    }
    /// Whether the triangle receives shadows.
    bool receives(std::uint32_t triangle) const { return receives_[triangle] != 0; }

private:
    /// A pixel's question, where its surface receives shadows and faces the light.
    struct Asked {
        bool asks = false;
        glm::dvec3 from_light{0, 0, 0};
        Lookup lookup;
    };
    /// Why the pixel of a row differs, where its centre tells.
    struct NamedCause {
        int x = 0;
        PixelCause cause;
    };

    const JudgedClaim& claim_;
    const LightView& light_;
    std::vector<std::uint8_t> receives_;
    std::vector<std::uint8_t> asks_;  ///< by triangle: receives shadows and faces the light
    std::vector<glm::dvec3> columns_; ///< lines of sight of pixels' centres: the sum of a column's
    std::vector<glm::dvec3> rows_;    ///< and a row's
    TexelSet asked_;                  ///< by pixels' centres
    std::vector<Texel> texels_;       ///< its list
    std::vector<std::optional<std::uint32_t>> shown_; ///< LightView::shown, by each
    std::atomic<std::size_t> not_shown_{0};           ///< how many no rasterizer would store
    std::vector<std::vector<NamedCause>> named_;      ///< by row, in ascending order

    Asked asked_at(PixelPlace p) const;
    /// How many comparisons find light at the pixel's centre, by the map as it was read back.
    int answer(const Asked& asked) const;
    /// Whether the claim follows from what the pixel's centre asks, and that is as predicted.
    bool answers_so(PixelPlace p, const Asked& asked) const;
    /// Whether what all texels hold that a pixel's centre asks is as predicted.
    bool are_shown(const Lookup& lookup) const;

    void add_asked(const Lookup& lookup);
    void trace_texels();
    /// Of a pixel's centre: where its claim is wrong, and follows from what is asked there.
    std::optional<WrongAnswer> wrong_answer(PixelPlace p) const;
    void name_wrong_answers();
    void name_wrong_answers(int first, int rows);
    std::optional<PixelCause> cause_named(PixelPlace p) const;
};

} // namespace shadowproof
