#include "reference/predict/whole_casters.h"

#include "reference/trace/tiles.h"
#include "scenes/surface/alpha_mask.h"

#include <algorithm>

namespace shadowproof {

Image<Visibility> under_whole_casters(const Tracer& tracer) {
    const Camera& camera = tracer.scene().camera;
    const Scene whole = without_masks(tracer.scene());
    const Tracer casters(whole, tracer.threads());
    Image<Visibility> visibility(camera.width, camera.height);
    const PixelRays rays(camera);
    const int strips = (camera.height + strip_height - 1) / strip_height;
    parallel_for(strips, tracer.threads(), [&](int strip, int) {
        Prober eye(tracer.state());
        Prober light(casters.state());
        const int end = std::min(camera.height, (strip + 1) * strip_height);
        Tile tile;
        for (int left = 0; left < camera.width; left += tile_side)
            for (int top = strip * strip_height; top < end; top += tile_side) {
                rays.set(tile, left, top);
                SeenLanes seen;
                LitLanes lighting;
                eye.see(tile.lines, tile.lanes, seen);
                light.light(tile.lines, tile.lanes, seen, lighting);
                tile.copy(lighting.visibility, visibility);
            }
    });
    return visibility;
}

} // namespace shadowproof
