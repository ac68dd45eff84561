// The libraries as another project meets them: a bundled scene is traced, drawn and compared, and
// the pixels are counted.
#include "compare/classify.h"
#include "compare/families.h"
#include "raster/render.h"
#include "reference/trace/trace.h"
#include "scenes/load/catalog.h"
#include "scenes/load/picture/encode_picture.h"

#include <algorithm>
#include <cstdio>
#include <exception>

using namespace shadowproof;

namespace {

int broken = 0;

void expect(bool holds, const char* sentence) {
    if (holds) return;
    std::fprintf(stderr, "counts: does not hold: %s\n", sentence);
    ++broken;
}

std::uint64_t count(const GroundTruth& truth, Visibility visibility) {
    const auto& pixels = truth.visibility.pixels;
    return static_cast<std::uint64_t>(std::count(pixels.begin(), pixels.end(), visibility));
}

void check() {
    const Scene scene = load_scene("near_plane", {.width = 96, .height = 64});
    const Plan plan = make_plan(scene);
    const Tracer tracer(scene);
    const GroundTruth truth = trace(tracer);
    const TraceStatistics& counts = truth.statistics;
    expect(counts.lit + counts.shadowed + counts.background == 96 * 64,
           "each pixel is lit, shadowed or background");
    expect(counts.lit > 0 && counts.lit == count(truth, Visibility::lit), "some are lit");
    expect(counts.shadowed > 0 && counts.shadowed == count(truth, Visibility::shadowed),
           "some are shadowed");

    const TracedScene traced(tracer, truth);
    Gpu gpu(GlPlatform::osmesa);
    const auto compare = [&](const char* technique) {
        const Frame frame = render(*find_technique(technique), scene, plan, gpu);
        return classify(traced, frame, *judge_of(traced, frame));
    };
    const auto pixels = [](const Comparison& comparison, Cause cause) {
        return comparison.causes[static_cast<std::size_t>(cause)];
    };
    const Comparison zpass = compare("zpass");
    expect(pixels(zpass, Cause::near_plane) > 0, "z-pass fails at the near plane");
    expect(pixels(zpass, Cause::unexplained) == 0, "and each of its pixels is explained");
    const Comparison zfail = compare("zfail");
    expect(zfail.differing == pixels(zfail, Cause::edge), "z-fail differs at edges alone");

    const PictureLayout gray{.width = 1, .height = 1, .channels = {{"Y"}}};
    const float half = 0.5F;
    expect(encode_picture(gray, &half, "half.exr").starts_with("v/1\x01"),
           "pictures are encoded by OpenImageIO");
}

} // namespace

int main() {
    try {
        check();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "counts: %s\n", error.what());
        return 1;
    }
    return broken == 0 ? 0 : 1;
}
