#include "compare/judge/pixel_record.h"

#include "reference/predict/ledger.h"
#include "reference/trace/faces.h"
#include "scenes/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace shadowproof {

namespace {

std::optional<double> depth_margin(const PixelLedger& ledger, std::uint32_t seen) {
    if (seen == no_triangle) return std::nullopt;
    double margin = std::numeric_limits<double>::infinity();
    for (const Crossing& crossing : ledger.crossings) {
        const bool own_cap =
            crossing.part == Crossing::Part::light_cap && crossing.triangle == seen;
        if (!own_cap) margin = std::min(margin, std::abs(crossing.depth - ledger.surface));
    }
    if (std::isinf(margin)) return std::nullopt;
    return margin;
}

/// Searches growing rings, until no pixel further out can be nearer.
std::optional<double> pixel_margin(const Image<Visibility>& truth, int x, int y) {
    const Visibility own = truth.at(x, y);
    long nearest = std::numeric_limits<long>::max(); // squared
    const auto look = [&](int i, int k) {
        if (i < 0 || k < 0 || i >= truth.width || k >= truth.height || truth.at(i, k) == own)
            return;
        const long dx = i - x;
        const long dy = k - y;
        nearest = std::min(nearest, dx * dx + dy * dy);
    };
    const int widest = std::max(truth.width, truth.height);
    for (int ring = 1; ring < widest && static_cast<long>(ring) * ring < nearest; ++ring)
        for (int i = -ring; i <= ring; ++i) {
            look(x + i, y - ring);
            look(x + i, y + ring);
            look(x - ring, y + i);
            look(x + ring, y + i);
        }
    if (nearest == std::numeric_limits<long>::max()) return std::nullopt;
    return std::sqrt(static_cast<double>(nearest));
}

} // namespace

std::string_view name_of(Exactness exactness) {
    switch (exactness) {
    case Exactness::filtered:
        return "filtered";
    case Exactness::exact:
        return "exact";
    case Exactness::degenerate:
        break;
    }
    return "degenerate";
}

PixelRecord record_pixel(const TracedScene& traced, int x, int y) {
    const Tracer& tracer = traced.tracer();
    const GroundTruth& truth = traced.truth();
    PixelRecord record;
    record.x = x;
    record.y = y;
    const Camera& camera = tracer.scene().camera;
    const glm::dvec3 line = line_of_sight(camera, x + 0.5, y + 0.5);
    record.start = start_of(camera, line);
    record.direction = direction_of(camera, line);
    record.visibility = truth.visibility.at(x, y);
    record.exactness = truth.exactness.at(x, y);
    record.seen = truth.triangle.at(x, y);
    if (record.seen != no_triangle)
        record.faces_light = sides_of(tracer, record.seen).faces_light();
    const RayTruth truth_again = trace_ray(tracer, line);
    record.in_cone = truth_again.in_cone;
    if (record.visibility == Visibility::shadowed) record.occluder = occluder_of(tracer, line);
    if (has_masks(tracer.scene()))
        record.let_through = count_let_through(tracer, line, record.seen);
    record.far = traced.far();
    record.depth = record.seen == no_triangle
                       ? std::numeric_limits<double>::infinity()
                       : depth_on_triangle(tracer.scene(), record.seen, line);
    record.ledger = pixel_ledger(tracer, truth, traced.depths(), x, y);
    record.depth_margin = depth_margin(record.ledger, record.seen);
    record.pixel_margin = pixel_margin(truth.visibility, x, y);
    return record;
}

PixelRecord in_units(PixelRecord record, double unit) {
    record.far *= unit;
    record.start *= unit;
    record.depth *= unit;
    record.ledger.surface *= unit;
    for (Crossing& crossing : record.ledger.crossings) crossing.depth *= unit;
    if (record.depth_margin) *record.depth_margin *= unit;
    return record;
}

} // namespace shadowproof
