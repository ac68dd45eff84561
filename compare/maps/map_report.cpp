#include "compare/maps/map_report.h"

#include "compare/json/blocks.h"
#include "compare/words.h"
#include "scenes/cause.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

namespace shadowproof {

namespace {

using Json = nlohmann::ordered_json;

Json settings_of(const MapModel& model, double unit) {
    Json json{{"size", model.size},
              {"bias", model.bias * unit},
              {"value", name_of(model.value)},
              {"format", name_of(model.format)},
              {"culling", name_of(model.culling)},
              {"near", model.near * unit},
              {"far", model.far * unit}};
    if (model.slope_bias != 0) json["slope_bias"] = model.slope_bias;
    if (model.filter > 0) {
        json["filter"] = model.filter;
        json["average"] = name_of(model.average);
    }
    return json;
}

/// Brighter where the texel's surface is closer to the light; the texels as a chequered pattern.
/// Black where the map is not asked.
Image<Rgb> texel_picture(const Frame& frame, const std::vector<std::optional<PixelLookup>>& at) {
    Image<Rgb> picture(frame.claim.width, frame.claim.height, Rgb{0, 0, 0});
    for (std::size_t i = 0; i < at.size(); ++i) {
        if (!at[i]) continue;
        const Texel& texel = at[i]->lookup.texel;
        const double share = std::clamp(at[i]->stored / frame.mapped->model.far, 0.0, 1.0);
        const double light = 1 - 0.75 * share - (((texel.x + texel.y) & 1) != 0 ? 0.12 : 0);
        const auto gray = static_cast<std::uint8_t>(std::lround(255 * light));
        // Faces are told apart by a tint.
        const auto tinted = static_cast<std::uint8_t>(gray - gray / 8 * (texel.face % 3));
        picture.pixels[i] = {tinted, gray, static_cast<std::uint8_t>(gray - gray / 5)};
    }
    return picture;
}

class MapReport final : public EvidenceReport {
public:
    MapReport(const MapModel& model, std::vector<std::optional<PixelLookup>> at,
              const Image<std::uint8_t>& cause, double unit)
        : header_(Json{{"map", settings_of(model, unit)}}.dump()), at_(std::move(at)) {
        for (std::size_t i = 0; i < at_.size(); ++i) {
            if (cause.pixels[i] == no_difference) continue;
            const PixelLookup pixel = at_[i].value_or(PixelLookup{});
            asked_.push_back(at_[i] ? 1 : 0);
            face_.push_back(static_cast<std::uint8_t>(pixel.lookup.texel.face));
            x_.push_back(static_cast<std::uint32_t>(pixel.lookup.texel.x));
            y_.push_back(static_cast<std::uint32_t>(pixel.lookup.texel.y));
            stored_.push_back(static_cast<float>(pixel.stored * unit));
            own_.push_back(static_cast<float>(pixel.lookup.value * unit));
            shown_.push_back(pixel.shown);
            lit_.push_back(static_cast<std::uint8_t>(pixel.lit));
        }
    }

    std::vector<Picture> pictures() const override {
        return {
            {"texels", [this](const Frame& frame) { return to_png(texel_picture(frame, at_)); }}};
    }
    std::string header() const override { return header_; }
    Blocks blocks(const Frame& /*frame*/) const override {
        return {{"map_asked", block(asked_)},   {"map_face", block(face_)},
                {"map_x", block(x_)},           {"map_y", block(y_)},
                {"map_stored", block(stored_)}, {"map_own", block(own_)},
                {"map_shown", block(shown_)},   {"map_lit", block(lit_)}};
    }

private:
    std::string header_;
    std::vector<std::optional<PixelLookup>> at_;
    // One per pixel that differs.
    std::vector<std::uint8_t> asked_;
    std::vector<std::uint8_t> face_;
    std::vector<std::uint32_t> x_;
    std::vector<std::uint32_t> y_;
    std::vector<float> stored_;
    std::vector<float> own_;
    std::vector<std::uint32_t> shown_;
    std::vector<std::uint8_t> lit_; ///< comparisons
};

} // namespace

EvidenceSummary summary_of_map(const MapEvidence& map, const MapFigures& figures, double unit) {
    EvidenceSummary summary;
    if (figures.unexplained > 0)
        summary.unexplained.push_back(
            fmt::format("{} of the map unexplained", counted(figures.unexplained, "texel")));
    Json results = settings_of(map.model, unit);
    results["texels"] = figures.asked;
    results["texels_unexplained"] = figures.unexplained;
    results["straddling"] = figures.straddling;
    results["ms"] = map.map_milliseconds;
    summary.results = Json{{"map", std::move(results)}}.dump();
    summary.pictures = {"texels"};
    return summary;
}

std::shared_ptr<const EvidenceReport> report_map(const MapEvidence& map,
                                                 std::vector<std::optional<PixelLookup>> at,
                                                 const Image<std::uint8_t>& cause, double unit) {
    return std::make_shared<MapReport>(map.model, std::move(at), cause, unit);
}

} // namespace shadowproof
