// The base class of judges of claims that consist of classes alone, without surface or counter.
// Nothing but the claim is predicted, and a pixel that differs is `edge` or unexplained.
#pragma once

#include "compare/judge/judge.h"

namespace shadowproof {

class ClassJudge : public Judge {
public:
    ClassJudge(const TracedScene& traced, const Frame& frame) : claim_{traced, frame} {}

    bool settles(PixelPlace p, std::optional<PixelCause>& cause) const override;
    std::vector<BandRadius> radii(std::span<const PixelPlace> places) const override;
    void look_around(const Region& region, std::span<const Neighbourhood> around,
                     std::span<const RayTruth> truths) const override;
    Finding look_around(PixelPlace p, const Neighbourhood& around,
                        std::span<const RayTruth> truth) const override;
    CoarseOutlines coarse_outlines() const override;
    std::shared_ptr<const EvidenceReport> report(const Image<std::uint8_t>& cause,
                                                 const MemoryBudget& left) const override;

protected:
    const JudgedClaim& claim() const { return claim_; }

private:
    JudgedClaim claim_;

    /// How far from its centre, in pixels, a pixel may show the truth, in addition to the driver's
    /// own error.
    virtual double footprint() const { return 0; }
    /// Whether what is true along a ray of its neighbourhood may make the pixel's claim.
    virtual bool allows(PixelPlace p, const RayTruth& truth) const;
};

} // namespace shadowproof
