// A technique that draws nothing: it claims the class map of a file, as `render -o truth.png`
// writes it, and takes a square of lit pixels for shadowed or partly lit. Set by environment
// variables:
//   SHADOWPROOF_REMEMBERED  the file
//   SHADOWPROOF_FORGOTTEN   the square's sides, pixels, in the middle of the picture; none: 0
//   SHADOWPROOF_SHARE       how much of the light it claims there, below 1; none: no claim of
//   shares
#include "raster/technique.h"
#include "scenes/error.h"
#include "scenes/load/picture/picture.h"

#include <cmath>
#include <cstdlib>

namespace shadowproof {

namespace {

Frame run(Gpu& /*gpu*/, const Scene& scene, const Plan& /*plan*/) {
    const char* const file = std::getenv("SHADOWPROOF_REMEMBERED");
    if (file == nullptr) throw Error("remembered", "remembers nothing", "name a class map");
    const MemoryAccount memory;
    const Picture picture = read_picture(file, {.memory = memory, .most_pixels = 1 << 26});
    const int width = scene.camera.width;
    const int height = scene.camera.height;
    if (picture.width != width || picture.height != height)
        throw Error(file, "is of another size", "render it again");
    Frame frame;
    frame.family = "remembered";
    frame.claim = Image<Visibility>(width, height);
    for (std::size_t i = 0; i < frame.claim.pixels.size(); ++i)
        frame.claim.pixels[i] = static_cast<Visibility>(
            std::lround(255 * picture.values[i * static_cast<std::size_t>(picture.channels)]));
    const char* const share = std::getenv("SHADOWPROOF_SHARE");
    if (share != nullptr) frame.share = Image<double>(width, height);
    const char* const sides = std::getenv("SHADOWPROOF_FORGOTTEN");
    const int half = sides == nullptr ? 0 : std::atoi(sides) / 2;
    for (int y = height / 2 - half; y < height / 2 + half; ++y)
        for (int x = width / 2 - half; x < width / 2 + half; ++x)
            if (Visibility& claim = frame.claim.at(x, y); claim == Visibility::lit) {
                claim = share == nullptr ? Visibility::shadowed : Visibility::partly_lit;
                if (share != nullptr) frame.share.at(x, y) = std::atof(share);
            }
    return frame;
}

} // namespace

Technique remembered_technique() {
    return {.name = "remembered",
            .summary = "claims what it remembers",
            .source = "tests/family",
            .needs = "a class map",
            .fails_at = {},
            .run = run};
}

} // namespace shadowproof
