#include "compare/picture/picture_judge.h"

#include "compare/judge/class_judge.h"
#include "compare/picture/picture_results.h"
#include "compare/words.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace shadowproof {

namespace {

/// Where the picture is antialiased, what is true anywhere in a pixel may be shown by it.
class PictureJudge final : public ClassJudge {
public:
    using ClassJudge::ClassJudge;

    std::string_view evidence() const override { return "picture"; }

    EvidenceSummary summary(const EvidenceCheck& /*check*/,
                            const Image<std::uint8_t>& cause) const override {
        std::uint64_t lit = 0;
        std::uint64_t shadowed = 0;
        for (std::size_t i = 0; i < cause.pixels.size(); ++i) {
            if (cause.pixels[i] == no_difference ||
                cause.pixels[i] == static_cast<std::uint8_t>(Cause::edge))
                continue;
            ++(claim().frame.claim.pixels[i] == Visibility::lit ? lit : shadowed);
        }
        const std::uint64_t undecidable = claim().frame.pictured->undecidable;
        EvidenceSummary summary;
        summary.results = nlohmann::ordered_json{
            {"falsely_lit", lit},
            {"falsely_shadowed", shadowed},
            {"undecidable",
             undecidable}}.dump();
        if (lit + shadowed > 0)
            summary.words =
                fmt::format("falsely lit {}, falsely shadowed {}", grouped(lit), grouped(shadowed));
        if (undecidable > 0)
            summary.words += fmt::format("{}undecidable {}", summary.words.empty() ? "" : ", ",
                                         grouped(undecidable));
        return summary;
    }

    Account account(const PixelRecord& record, double /*unit*/) const override {
        const PicturedShadows& shadows = *claim().frame.pictured;
        const bool decided = shadows.decided.at(record.x, record.y) != 0;
        const float share = shadows.lit_share.at(record.x, record.y);
        Account account;
        account.columns = {{"lit share", decided ? fmt::format("{:.3f}", share) : "undecided"}};
        nlohmann::ordered_json members;
        members["lit_share"] = decided ? nlohmann::ordered_json(share) : nullptr;
        account.members = members.dump();
        return account;
    }

private:
    double footprint() const override { return claim().frame.pictured->antialiased ? 0.5 : 0; }

    /// Colours tell the class of the mesh that they were fitted for, and of no other.
    bool allows(PixelPlace p, const RayTruth& truth) const override {
        const Scene& scene = claim().traced.scene();
        const std::uint32_t own = claim().traced.truth().triangle.at(p.x, p.y);
        return truth.visibility == claim().frame.claim.at(p.x, p.y) ||
               truth.triangle == no_triangle ||
               mesh_of(scene, truth.triangle) != mesh_of(scene, own);
    }
};

std::unique_ptr<Judge> judge(const TracedScene& traced, const Frame& frame) {
    return std::make_unique<PictureJudge>(traced, frame);
}

} // namespace

Family picture_family() {
    return {.name = "picture",
            .summary = "a picture that another renderer made",
            .judge = judge,
            .check_results = check_picture_results};
}

} // namespace shadowproof
