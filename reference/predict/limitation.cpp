#include "reference/predict/limitation.h"

#include <cmath>
#include <limits>

namespace shadowproof {

namespace {

constexpr int unlimited_bits = 32; ///< enough for any number of faces

bool counts_in_front(const CountingModel& model) {
    return model.counting.test == Counting::Test::depth_pass;
}

/// Whether caps are missing. Dark caps past a far plane that clips are lost by far_clip.
bool lacks_caps(const CountingModel& model) {
    const Counting& counting = model.counting;
    return !counting.light_cap ||
           (!counts_in_front(model) && !counting.dark_cap && !model.depth_model.clips_at_far());
}

/// Parallel lines of sight come from infinity.
double depth_of_eye(const DepthModel& depth_model) {
    return depth_model.parallel ? -std::numeric_limits<double>::infinity() : 0;
}

void lift(Limitation limitation, CountingModel& model) {
    Counting& counting = model.counting;
    DepthModel& depth_model = model.depth_model;
    switch (limitation) {
    case Limitation::near_clip:
        depth_model.near = depth_of_eye(depth_model);
        break;
    case Limitation::far_clip:
        depth_model.projection = depth_model.reversed() ? DepthModel::Projection::infinite_reversed
                                                        : DepthModel::Projection::infinite;
        counting.dark_cap = true;
        break;
    case Limitation::eye_start:
        counting.start = Counting::Start::eye;
        break;
    case Limitation::extrusion:
        counting.extrusion = std::numeric_limits<double>::infinity();
        break;
    case Limitation::caps:
        counting.light_cap = counting.dark_cap = true;
        break;
    case Limitation::counter:
        if (counting.operation == Counting::Operation::saturate)
            counting.operation = Counting::Operation::wrap;
        counting.bits = unlimited_bits;
        break;
    case Limitation::parity:
        counting.operation = Counting::Operation::wrap;
        counting.bits = unlimited_bits;
        break;
    case Limitation::open_mesh:
        counting.holes_filled = false;
        counting.flips.averted = Counting::Flips::Averted::of_all_shells;
        break;
    case Limitation::light_inside:
        counting.flips.around_light = true;
        break;
    case Limitation::alpha: // volumes are of triangles: no way of counting them lifts it
        break;
    }
}

} // namespace

Cause cause_of(Limitation limitation) {
    switch (limitation) {
    case Limitation::near_clip:
        return Cause::near_plane;
    case Limitation::far_clip:
        return Cause::far_plane;
    case Limitation::eye_start:
        return Cause::eye_inside;
    case Limitation::extrusion:
        return Cause::extrusion;
    case Limitation::caps:
        return Cause::cap;
    case Limitation::counter:
        return Cause::counter;
    case Limitation::parity:
        return Cause::parity;
    case Limitation::open_mesh:
        return Cause::open_mesh;
    case Limitation::light_inside:
        return Cause::light_inside;
    case Limitation::alpha:
        break;
    }
    return Cause::alpha;
}

std::vector<Limitation> listed(Limitations limitations) {
    std::vector<Limitation> list;
    for (int i = 0; i < limitation_count; ++i)
        if (limitations.contains(static_cast<Limitation>(i)))
            list.push_back(static_cast<Limitation>(i));
    return list;
}

Limitations limitations_of(const CountingModel& model) {
    const Counting& counting = model.counting;
    Limitations found;
    const auto add = [&](bool has, Limitation limitation) {
        if (has) found = found | limitation;
    };
    // A counter that starts with the near plane's count includes what lies before that plane.
    add(counts_in_front(model) && counting.start != Counting::Start::near_plane &&
            !model.depth_model.clamp,
        Limitation::near_clip);
    add(!counts_in_front(model) && model.depth_model.clips_at_far(), Limitation::far_clip);
    add(counts_in_front(model) && counting.start == Counting::Start::zero, Limitation::eye_start);
    add(std::isfinite(counting.extrusion), Limitation::extrusion);
    add(lacks_caps(model), Limitation::caps);
    // Inverting keeps one bit of the count, however many the buffer has.
    const bool inverts = counting.operation == Counting::Operation::invert;
    add(!inverts, Limitation::counter);
    add(inverts, Limitation::parity);
    add(true, Limitation::open_mesh);
    add(!counting.flips.around_light, Limitation::light_inside);
    return found;
}

CountingModel without(CountingModel model, Limitations limitations) {
    for (const Limitation limitation : listed(limitations)) lift(limitation, model);
    return model;
}

} // namespace shadowproof
