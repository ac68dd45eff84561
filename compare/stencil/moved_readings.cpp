#include "compare/stencil/pixel_readings.h"
#include "reference/predict/prediction.h"

#include <algorithm>

namespace shadowproof {

void add_moved(const Counting& counting, std::int64_t least, std::int64_t most, bool by_depth,
               std::vector<Reading>& readings) {
    const std::size_t unmoved = readings.size();
    for (std::int64_t by = least; by <= most; ++by)
        for (std::size_t i = 0; by != 0 && i < unmoved; ++i) {
            Reading moved = readings[i];
            moved.count = stepped(moved.count, by, counting);
            moved.ideal += by;
            moved.off_ray += by;
            moved.by_rounding = true;
            moved.by_depth = moved.by_depth || by_depth;
            readings.push_back(moved);
        }
}

void add_edge_on_sides(const PixelFaces& pixel, std::vector<Reading>& readings) {
    sort_out(readings);
    const std::int64_t edge_on = pixel.volumes().counted.edge_on_sides(pixel.around().corners);
    // Those seen edge-on are slivers, too.
    const std::int64_t most = std::max(edge_on, pixel.slivers_of_any_depth().sides);
    add_moved(pixel.counting(), -most, most, false, readings);
}

void add_slivers(const PixelFaces& pixel, std::vector<Reading>& readings) {
    sort_out(readings);
    const StepRange steps = pixel.steps_of_slivers();
    const Slivers::Number others = pixel.slivers_of_any_depth();
    add_moved(pixel.counting(), steps.least - others.caps, steps.most + others.caps + others.layers,
              false, readings);
}

} // namespace shadowproof
