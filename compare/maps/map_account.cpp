#include "compare/maps/map_account.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace shadowproof {

Account account_of_lookup(const std::optional<PixelLookup>& pixel, const MapModel& model,
                          double unit) {
    // JSON has no infinity.
    const auto length = [&](double world) -> nlohmann::ordered_json {
        if (!std::isfinite(world)) return nullptr;
        return world * unit;
    };
    const auto side = [&](double world) {
        return std::isfinite(world) ? fmt::format("{:.3g}", world * unit) : "endless";
    };
    Account account;
    nlohmann::ordered_json members;
    if (!pixel) {
        account.columns = {{"face", "-"}, {"texel", "-"}, {"footprint", "-"},
                           {"map", "-"},  {"bias", "-"},  {"own", "-"}};
        if (model.filter > 0) account.columns.push_back({"lit", "-"});
        account.remark = {"shows", "not asked"};
        members["map"] = nullptr;
    } else {
        const Texel& texel = pixel->lookup.texel;
        account.columns = {
            {"face", fmt::format("{}", texel.face)},
            {"texel", fmt::format("({},{})", texel.x, texel.y)},
            {"footprint", fmt::format("{}x{}", side(pixel->footprint.x), side(pixel->footprint.y))},
            {"map", fmt::format("{:.6g}", pixel->stored * unit)},
            {"bias", fmt::format("{:.3g}", model.bias * unit)},
            {"own", fmt::format("{:.6g}", pixel->lookup.value * unit)}};
        account.remark = {"shows", pixel->shown == no_triangle
                                       ? std::string("nothing")
                                       : fmt::format("triangle {}", pixel->shown)};
        if (model.filter > 0)
            account.columns.push_back({"lit", fmt::format("{}/{}", pixel->lit, model.asked())});
        members["map"] = {{"face", texel.face},
                          {"texel", {texel.x, texel.y}},
                          {"size", model.size},
                          {"value", name_of(model.value)},
                          {"format", name_of(model.format)},
                          {"near", model.near * unit},
                          {"far", model.far * unit},
                          {"stored", pixel->stored * unit},
                          {"bias", model.bias * unit},
                          {"own", pixel->lookup.value * unit},
                          {"width", pixel->width * unit},
                          {"footprint", {length(pixel->footprint.x), length(pixel->footprint.y)}},
                          {"shows", pixel->shown == no_triangle
                                        ? nlohmann::ordered_json(nullptr)
                                        : nlohmann::ordered_json(pixel->shown)}};
        if (model.slope_bias != 0) members["map"]["slope_bias"] = model.slope_bias;
        if (model.offset_units != 0) members["map"]["offset_units"] = model.offset_units;
        if (model.filter > 0) {
            members["map"]["lit"] = pixel->lit;
            members["map"]["of"] = model.asked();
            members["map"]["filter"] = model.filter;
            members["map"]["average"] = name_of(model.average);
            if (model.shape == MapModel::Shape::cube)
                members["map"]["edges"] = name_of(model.edges);
        }
    }
    account.members = members.dump();
    return account;
}

} // namespace shadowproof
