#include "compare/maps/map_claim.h"

#include <cmath>

namespace shadowproof {

int claimed_lit(const JudgedClaim& claim, PixelPlace p) {
    const Frame& frame = claim.frame;
    const MapModel& model = frame.mapped->model;
    switch (frame.claim.at(p.x, p.y)) {
    case Visibility::lit:
        return model.asked();
    case Visibility::shadowed:
        return 0;
    case Visibility::partly_lit: {
        if (model.average != MapAverage::comparisons || frame.share.pixels.empty()) return -1;
        const double share = frame.share.at(p.x, p.y);
        const auto count = static_cast<int>(std::lround(share * model.asked()));
        const bool is_count = share == 1.0 * count / model.asked();
        return is_count && count > 0 && count < model.asked() ? count : -1;
    }
    case Visibility::background:
        break;
    }
    return -1;
}

bool claims_light(const JudgedClaim& claim, PixelPlace p) {
    const Visibility claimed = claim.frame.claim.at(p.x, p.y);
    if (claimed != Visibility::partly_lit) return claimed == Visibility::lit;
    return claim.traced.truth().visibility.at(p.x, p.y) != Visibility::lit;
}

} // namespace shadowproof
