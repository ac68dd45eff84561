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
    if (model.offset_units != 0) json["offset_units"] = model.offset_units;
    if (model.filter > 0) {
        json["filter"] = model.filter;
        json["average"] = name_of(model.average);
        if (model.shape == MapModel::Shape::cube) json["edges"] = name_of(model.edges);
    }
    return json;
}

/// For each pixel a number of the texel that it asks, 0 where it asks none: one more than
/// 6 * share + 2 * (face % 3) + parity. `share`: of the far plane's distance, in texel_shares
/// steps; `parity`: by which texels beside each other are told apart.
std::vector<std::uint8_t> asked_texels(const MapModel& model,
                                       const std::vector<std::optional<PixelLookup>>& at) {
    constexpr int texel_shares = 40;
    std::vector<std::uint8_t> asked;
    asked.reserve(at.size());
    for (const std::optional<PixelLookup>& pixel : at) {
        if (!pixel) {
            asked.push_back(0);
            continue;
        }
        const Texel& texel = pixel->lookup.texel;
        const long share =
            std::lround(texel_shares * std::clamp(pixel->stored / model.far, 0.0, 1.0));
        asked.push_back(static_cast<std::uint8_t>(1 + 6 * share + 2 * (texel.face % 3) +
                                                  ((texel.x + texel.y) & 1)));
    }
    return asked;
}

/// How many pixels a side of a face has in the report.
int pictured_size(const MapModel& model) {
    return std::min(model.size, 128);
}

/// The faces one after the other, in fewer pixels: of the texels of each the one nearest to the
/// light, as its share of the far plane, 255.
std::vector<std::uint8_t> pictured_faces(const MapEvidence& map) {
    const int side = pictured_size(map.model);
    std::vector<std::uint8_t> pictured;
    for (const Image<float>& face : map.faces) {
        Image<float> nearest(side, side, 1.0F);
        for (int y = 0; y < map.model.size; ++y)
            for (int x = 0; x < map.model.size; ++x) {
                float& pixel = nearest.at(x * side / map.model.size, y * side / map.model.size);
                pixel = std::min(pixel, face.at(x, y));
            }
        for (const float stored : nearest.pixels) {
            const double share = value_of_stored(map.model, stored) / map.model.far;
            pictured.push_back(
                static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0))));
        }
    }
    return pictured;
}

class MapReport final : public EvidenceReport {
public:
    MapReport(const MapEvidence& map, const std::vector<std::optional<PixelLookup>>& at,
              const Image<std::uint8_t>& cause, double unit)
        : header_(Json{{"map", header_of(map.model, unit)}}.dump()), faces_(pictured_faces(map)),
          texels_(asked_texels(map.model, at)), differing_(differing_list(cause)) {
        for (std::size_t i = 0; i < at.size(); ++i) {
            if (cause.pixels[i] == no_difference) continue;
            const PixelLookup pixel = at[i].value_or(PixelLookup{});
            asked_.push_back(at[i] ? 1 : 0);
            face_.push_back(static_cast<std::uint8_t>(pixel.lookup.texel.face));
            x_.push_back(static_cast<std::uint32_t>(pixel.lookup.texel.x));
            y_.push_back(static_cast<std::uint32_t>(pixel.lookup.texel.y));
            stored_.push_back(static_cast<float>(pixel.stored * unit));
            own_.push_back(static_cast<float>(pixel.lookup.value * unit));
            shown_.push_back(pixel.shown);
            lit_.push_back(static_cast<std::uint8_t>(pixel.lit));
            width_.push_back(static_cast<float>(pixel.width * unit));
            foot_x_.push_back(static_cast<float>(pixel.footprint.x * unit));
            foot_y_.push_back(static_cast<float>(pixel.footprint.y * unit));
        }
    }

    std::string header() const override { return header_; }
    Blocks blocks(const Frame& frame, const GroundTruth& /*truth*/, Memo& memo) const override {
        const auto of_differing = [&](const auto& list) {
            return differing_block(NumberList(list), frame.claim.width, differing_, {}, &memo);
        };
        const int side = pictured_size(frame.mapped->model);
        return {{"map_asked", of_differing(asked_)},
                {"map_face", of_differing(face_)},
                {"map_x", of_differing(x_)},
                {"map_y", of_differing(y_)},
                {"map_stored", of_differing(stored_)},
                {"map_own", of_differing(own_)},
                {"map_shown", of_differing(shown_)},
                {"map_lit", of_differing(lit_)},
                {"map_width", of_differing(width_)},
                {"map_foot_x", of_differing(foot_x_)},
                {"map_foot_y", of_differing(foot_y_)},
                {"map_faces", areas_block(NumberList(faces_), side, {}, &memo)},
                {"texels", areas_block(NumberList(texels_), frame.claim.width, {}, &memo)}};
    }

private:
    std::string header_;
    std::vector<std::uint8_t> faces_;
    std::vector<std::uint8_t> texels_; ///< asked_texels
    NumberList differing_;
    // One per pixel that differs.
    std::vector<std::uint8_t> asked_;
    std::vector<std::uint8_t> face_;
    std::vector<std::uint32_t> x_;
    std::vector<std::uint32_t> y_;
    std::vector<float> stored_;
    std::vector<float> own_;
    std::vector<std::uint32_t> shown_;
    std::vector<std::uint8_t> lit_; ///< comparisons
    std::vector<float> width_;
    std::vector<float> foot_x_;
    std::vector<float> foot_y_;

    static Json header_of(const MapModel& model, double unit) {
        Json header = settings_of(model, unit);
        header["faces"] = model.faces();
        header["pictured"] = pictured_size(model);
        return header;
    }
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
    return summary;
}

std::shared_ptr<const EvidenceReport> report_map(const MapEvidence& map,
                                                 const std::vector<std::optional<PixelLookup>>& at,
                                                 const Image<std::uint8_t>& cause, double unit) {
    return std::make_shared<MapReport>(map, at, cause, unit);
}

} // namespace shadowproof
