// Starts OpenGL in a worker process.
#pragma once

#include "compare/command/pieces/pieces.h"
#include "raster/gl/context.h"

#include <memory>

namespace shadowproof {

/// Starting is given a minute at least, whatever the time limit, because it also starts compilers
/// of shaders. Where a driver crashes or hangs here, the run cannot go on: throws Error.
inline std::unique_ptr<Gpu> start_gpu(Pieces& pieces, GlPlatform platform) {
    constexpr double least_seconds = 60;
    try {
        return pieces.step(
            "starting OpenGL", [&] { return std::make_unique<Gpu>(platform); }, least_seconds);
    } catch (const LostPiece& lost) {
        throw Error("OpenGL", lost.why, "see the driver's own messages, or try another --gl");
    }
}

} // namespace shadowproof
