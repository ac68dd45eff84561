// Shades points under all lights that a picture adds up.
#pragma once

#include "reference/shade/shading.h"

#include <cstddef>
#include <memory>
#include <span>

namespace shadowproof {

/// For one thread.
class AddedShader {
public:
    AddedShader(const Tracer& tracer, const TracedLights& before);
    /// For another thread; shares what it is made of.
    AddedShader(const AddedShader& other);
    AddedShader& operator=(const AddedShader&) = delete;
    ~AddedShader();

    /// The tracer's own and those before it.
    std::size_t lights() const;

    /// `points`, `shadings`: of each place one per light, side by side, the tracer's own last. The
    /// last of a place holds in before_color what the others add.
    void shade(std::span<const SeenPoint> points, std::span<Shading> shadings);

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace shadowproof
