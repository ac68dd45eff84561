// The smallest judge there can be: of claims without surface, evidence or colours. A pixel that
// differs is `edge` where its class is true somewhere in its band, else unexplained.
#include "compare/judge/class_judge.h"

namespace shadowproof {

namespace {

class RememberedJudge final : public ClassJudge {
public:
    using ClassJudge::ClassJudge;

    std::string_view evidence() const override { return "memory"; }

    EvidenceSummary summary(const EvidenceCheck& /*check*/,
                            const Image<std::uint8_t>& /*cause*/) const override {
        return {};
    }
    Account account(const PixelRecord& record, double /*unit*/) const override {
        Account account;
        account.columns = {
            {"remembered", std::string(name_of(claim().frame.claim.at(record.x, record.y)))}};
        account.members = R"({"remembered":true})";
        return account;
    }
};

std::unique_ptr<Judge> judge(const TracedScene& traced, const Frame& frame) {
    return std::make_unique<RememberedJudge>(traced, frame);
}

} // namespace

Family remembered_family() {
    return {.name = "remembered", .summary = "claims from memory", .judge = judge};
}

} // namespace shadowproof
