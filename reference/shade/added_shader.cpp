#include "reference/shade/added_shader.h"

#include "reference/shade/point_shader.h"

#include <algorithm>
#include <cassert>
#include <vector>

namespace shadowproof {

namespace {

using AddedTables = std::vector<ShadingTables>; ///< one per light

std::shared_ptr<const AddedTables> make_tables(const Tracer& tracer, const TracedLights& before) {
    auto tables = std::make_shared<AddedTables>();
    tables->push_back(make_shading_tables(tracer));
    for (const auto& light : before)
        tables->push_back(make_shading_tables(light->tracer, tables->front()));
    std::ranges::rotate(*tables, tables->begin() + 1); // the tracer's own last
    return tables;
}

} // namespace

struct AddedShader::State {
    std::shared_ptr<const AddedTables> tables;
    std::vector<PointShader> shaders{}; ///< one per light

    explicit State(std::shared_ptr<const AddedTables> of) : tables(std::move(of)) {
        for (const ShadingTables& light : *tables) shaders.emplace_back(light);
    }
};

AddedShader::AddedShader(const Tracer& tracer, const TracedLights& before)
    : state_(std::make_unique<State>(make_tables(tracer, before))) {}
AddedShader::AddedShader(const AddedShader& other)
    : state_(std::make_unique<State>(other.state_->tables)) {}
AddedShader::~AddedShader() = default;

std::size_t AddedShader::lights() const {
    return state_->shaders.size();
}

void AddedShader::shade(std::span<const SeenPoint> points, std::span<Shading> shadings) {
    assert(points.size() == shadings.size() && points.size() % lights() == 0);
    const std::size_t places = points.size() / lights();
    for (std::size_t first = 0; first < places; first += packet_size) {
        const std::size_t count = std::min<std::size_t>(packet_size, places - first);
        for (std::size_t light = 0; light < lights(); ++light) {
            PointShader& shader = state_->shaders[light];
            const auto at = [&](std::size_t lane) { return (first + lane) * lights() + light; };
            for (std::size_t lane = 0; lane < count; ++lane) {
                const SeenPoint& point = points[at(lane)];
                shader.set(lane, point.line, point.triangle, point.lit);
            }
            shader.shade();
            for (std::size_t lane = 0; lane < count; ++lane)
                shadings[at(lane)] = shader.terms(lane);
        }
    }
    if (lights() == 1) return;
    for (std::size_t i = 0; i < places; ++i) {
        const std::span<Shading> of_place = shadings.subspan(i * lights(), lights());
        for (const Shading& shading : of_place.first(lights() - 1))
            of_place.back().before_color += shading.added_color();
    }
}

} // namespace shadowproof
