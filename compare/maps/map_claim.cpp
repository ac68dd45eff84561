#include "compare/maps/map_claim.h"

namespace shadowproof {

int claimed_lit(const JudgedClaim& claim, PixelPlace p) {
    const Frame& frame = claim.frame;
    const MapModel& model = frame.mapped->model;
    const Image<std::uint8_t>& lit = frame.mapped->lit_comparisons;
    switch (frame.claim.at(p.x, p.y)) {
    case Visibility::lit:
        return model.asked();
    case Visibility::shadowed:
        return 0;
    case Visibility::partly_lit: {
        if (lit.width != frame.claim.width || lit.height != frame.claim.height) return -1;
        const int count = lit.at(p.x, p.y);
        const bool may_be = model.average == MapAverage::comparisons && count > 0;
        return may_be && count < model.asked() ? count : -1;
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

double wrongness(const JudgedClaim& claim, PixelPlace p) {
    const Visibility truth = claim.traced.truth().visibility.at(p.x, p.y);
    const bool partly = claim.frame.claim.at(p.x, p.y) == Visibility::partly_lit &&
                        truth != Visibility::background && claimed_lit(claim, p) > 0;
    if (!partly) return 1;
    const double light = lit_share(claim.frame, claim.frame.claim.index(p.x, p.y));
    return truth == Visibility::lit ? 1 - light : light;
}

} // namespace shadowproof
