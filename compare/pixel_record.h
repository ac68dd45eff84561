// All that is known of one pixel: what `explain` prints, writes as JSON (schema
// shadowproof/pixel/1) and draws, and what the report's inspector shows.
#pragma once

#include "compare/classify.h"
#include "compare/color_check.h"
#include "compare/pixel_ledger.h"
#include "reference/tally.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace shadowproof {

/// What one technique says of the pixel.
struct TechniqueAtPixel {
    std::string name;
    std::string error; ///< not empty: it could not run; the rest is then meaningless
    Counting counting;
    std::int64_t start = 0;     ///< the counter before any face
    std::int64_t predicted = 0; ///< the counter before wrapping
    std::uint32_t stored = 0;   ///< as the stencil buffer ought to hold it
    std::uint32_t read_back = 0;
    Visibility claim = Visibility::background;
    std::uint32_t shown = no_triangle;  ///< the triangle read back
    std::uint8_t cause = no_difference; ///< Cause, or no_difference
    /// Where the technique's volumes are not the casters' own, what the ray crosses of them;
    /// nothing where the record's ledger holds.
    std::optional<std::vector<Crossing>> crossings;
    Scene casters;                   ///< of those volumes
    std::vector<glm::vec3> far_ends; ///< where the casters' positions lie once extruded
    std::vector<Tally> tallies;      ///< one a crossing
    /// One a crossing, where the technique does not count all casters alike; else empty.
    std::vector<Counting::Test> tests;
    Tally dark_caps = Tally::beyond;
    std::int64_t dark_cap_count = 0;   ///< at infinity
    std::optional<ColorAccount> color; ///< where it lights bump maps
};

struct PixelRecord {
    int x = 0;
    int y = 0;
    glm::dvec3 direction{0, 0, 0}; ///< of the eye ray; its parameter is view depth
    Visibility visibility = Visibility::background;
    Exactness exactness = Exactness::filtered;
    std::uint32_t seen = no_triangle;
    bool faces_light = false;             ///< the seen side is the light's
    bool in_cone = true;                  ///< false outside a spot light's cone
    std::uint32_t occluder = no_triangle; ///< where shadowed by one: some triangle in between
    double far = 0;                       ///< the finite far plane's depth
    PixelLedger ledger;
    /// How far the surface lies from the nearest crossing but its own light cap, in view depth;
    /// nothing where either is missing.
    std::optional<double> depth_margin;
    /// How far the nearest pixel is whose truth is another class, between centres, in pixels;
    /// nothing where all are one.
    std::optional<double> pixel_margin;
    std::vector<TechniqueAtPixel> techniques;
};

/// The record without techniques. (x, y) must lie in the picture.
PixelRecord record_pixel(const Tracer& tracer, const GroundTruth& truth, const ShadowDepths& depths,
                         int x, int y);

/// The crossings that a technique's tallies speak of.
inline const std::vector<Crossing>& crossings_of(const PixelRecord& record,
                                                 const TechniqueAtPixel& technique) {
    return technique.crossings ? *technique.crossings : record.ledger.crossings;
}

/// What a technique that drew `frame`, classified as `comparison`, did at the record's pixel.
TechniqueAtPixel technique_at(const PixelRecord& record, const Prediction& prediction,
                              std::string name, const Frame& frame, const Comparison& comparison);

/// The record with all its lengths times `unit` (Scene::unit), which must be a power of two.
PixelRecord in_units(PixelRecord record, double unit);

/// Schema shadowproof/pixel/1.
nlohmann::ordered_json to_json(const Scene& scene, const PixelRecord& record);

std::string_view name_of(Visibility visibility); ///< "lit"
std::string_view name_of(Exactness exactness);   ///< "filtered"

} // namespace shadowproof
