// The judge of a claim: what a family of claims implements, pixel by pixel and for the claim as a
// whole. Edges, verdicts, the gate and the report know no family; they read what its judge returns.
#pragma once

#include "compare/driver/coarse_outlines.h"
#include "compare/driver/neighbourhood.h"
#include "compare/judge/account.h"
#include "compare/judge/evidence_report.h"
#include "compare/judge/pixel_record.h"
#include "reference/predict/traced_scene.h"
#include "scenes/cause.h"
#include "scenes/frame.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace shadowproof {

struct JsonPlace; // compare/json/json_place.h
struct MemoryBudget;
struct TechniqueSettings;

struct PixelPlace {
    int x = 0;
    int y = 0;
};

/// A claim beside the truth.
struct JudgedClaim {
    const TracedScene& traced;
    const Frame& frame;

    bool differs(PixelPlace p) const {
        return frame.claim.at(p.x, p.y) != traced.truth().visibility.at(p.x, p.y);
    }
    /// Whether the triangle shown is the one truly seen; true where the claim shows no surface.
    bool surface_as_true(PixelPlace p) const {
        return !frame.shows_surface() ||
               frame.triangle.at(p.x, p.y) == traced.truth().triangle.at(p.x, p.y);
    }
};

/// Why one pixel differs.
struct PixelCause {
    Cause cause = Cause::unexplained;
    /// Further limitations that must be lifted together with `cause` to make the pixel right.
    CauseSet also{};
    /// The cause is `precision`, though the surface is so near that the technique's numbers
    /// suffice.
    bool too_near = false;
};

/// What was found by looking at a pixel's surroundings.
struct Finding {
    bool evidence_in_band = false; ///< what was read back is predicted somewhere in its band
    PixelCause cause;              ///< where the pixel differs
};

/// Pixels of one region of the picture (region_side), looked at together.
struct Region {
    std::span<const PixelPlace> places;
    std::span<Finding> findings; ///< one per place
};

/// The judge of one claim. Its functions are called by several threads at once.
class Judge {
public:
    Judge() = default;
    virtual ~Judge() = default;
    Judge(const Judge&) = delete;
    Judge& operator=(const Judge&) = delete;

    /// What the evidence is called in messages: "counter".
    virtual std::string_view evidence() const = 0;

    /// Settle: whether what was read back at the pixel is what is predicted at its centre, and its
    /// claim, if it differs from the truth, follows from that; `cause` is then named. Called from
    /// many threads at once.
    virtual bool settles(PixelPlace p, std::optional<PixelCause>& cause) const = 0;

    /// For each pixel, how far aside what is drawn there may lie. `places`: of one region.
    virtual std::vector<BandRadius> radii(std::span<const PixelPlace> places) const = 0;

    /// Name: what may be drawn at the region's pixels within their neighbourhoods, one per place.
    /// `truths`: along the rays of all neighbourhoods, one pixel after the other.
    virtual void look_around(const Region& region, std::span<const Neighbourhood> around,
                             std::span<const RayTruth> truths) const = 0;
    /// The same of one pixel, where the neighbourhood is some other place's.
    virtual Finding look_around(PixelPlace p, const Neighbourhood& around,
                                std::span<const RayTruth> truth) const = 0;

    /// Name, where none of this explains a pixel: what may be drawn there by the errors of all that
    /// is drawn, wherever it lies. Changes the findings that it explains.
    virtual void look_at_all_faces(std::span<const PixelPlace> /*places*/,
                                   std::span<Finding> /*findings*/) const {}

    /// Outlines that the clipper may draw far aside, of surfaces and of what else is drawn.
    virtual CoarseOutlines coarse_outlines() const = 0;

    /// What the evidence says about the claim as a whole. `cause`: Comparison::cause.
    virtual EvidenceSummary summary(const EvidenceCheck& check,
                                    const Image<std::uint8_t>& cause) const = 0;
    /// What a report shows of the evidence; null where that is nothing. Throws Error where that
    /// takes more memory than is left beside the program.
    virtual std::shared_ptr<const EvidenceReport> report(const Image<std::uint8_t>& cause,
                                                         const MemoryBudget& left) const = 0;

    /// Derive: how near the technique is to failing on this scene, by its arithmetic and the truth
    /// alone, whatever was drawn; beyond 1 some pixel is expected to be wrong. None where nothing
    /// is derived.
    virtual std::optional<double> strain() const { return std::nullopt; }

    /// Account: the story of the record's pixel, its lengths times `unit` (Scene::unit).
    virtual Account account(const PixelRecord& record, double unit) const = 0;
};

/// A family of claims, by the name that frames give (Frame::family).
struct Family {
    std::string_view name;
    std::string_view summary; ///< one clause: what its evidence is
    std::unique_ptr<Judge> (*judge)(const TracedScene& traced, const Frame& frame) = nullptr;
    /// Checks what EvidenceSummary::results has added to a cell of results.json that is read back,
    /// by the rules of json_rules.h; the members of all families are checked already. Throws Error.
    /// Null: it adds nothing.
    void (*check_results)(const JsonPlace& cell) = nullptr;
    /// Throws Error naming the setting where what was asked for takes more memory than there is,
    /// beside that of compare/memory.h. Null: its settings take none.
    void (*require_memory)(const MemoryBudget& budget, const TechniqueSettings& asked) = nullptr;
};

} // namespace shadowproof
