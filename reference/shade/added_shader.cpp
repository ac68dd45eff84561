#include "reference/shade/added_shader.h"

#include <cassert>

namespace shadowproof {

AddedShader::AddedShader(const Tracer& tracer, const TracedLights& before) {
    for (const auto& light : before) shaders_.push_back(std::make_unique<RayShader>(light->tracer));
    shaders_.push_back(std::make_unique<RayShader>(tracer));
}

void AddedShader::shade(std::span<const SeenPoint> points, std::span<Shading> shadings) {
    assert(points.size() == shadings.size() && points.size() % lights() == 0);
    if (lights() == 1) {
        shaders_.front()->shade(points, shadings);
        return;
    }
    const std::size_t places = points.size() / lights();
    points_.resize(places);
    shadings_.resize(places);
    for (std::size_t light = 0; light < lights(); ++light) {
        for (std::size_t i = 0; i < places; ++i) points_[i] = points[i * lights() + light];
        shaders_[light]->shade(points_, shadings_);
        for (std::size_t i = 0; i < places; ++i) shadings[i * lights() + light] = shadings_[i];
    }
    for (std::size_t i = 0; i < places; ++i) {
        const std::span<Shading> of_place = shadings.subspan(i * lights(), lights());
        for (const Shading& shading : of_place.first(lights() - 1))
            of_place.back().before_color += shading.added_color();
    }
}

} // namespace shadowproof
