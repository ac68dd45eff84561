// Shades points under all lights that a picture adds up.
#pragma once

#include "reference/shade/shading.h"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace shadowproof {

/// A shader of each light, the chosen one's last. For one thread.
class AddedShader {
public:
    AddedShader(const Tracer& tracer, const TracedLights& before);

    std::size_t lights() const { return shaders_.size(); }

    /// `points`, `shadings`: of each place one per light, side by side. The last of a place holds
    /// in before_color what the others add.
    void shade(std::span<const SeenPoint> points, std::span<Shading> shadings);

private:
    std::vector<std::unique_ptr<RayShader>> shaders_;
    std::vector<SeenPoint> points_; ///< of one light
    std::vector<Shading> shadings_;
};

} // namespace shadowproof
