// Whether the truth and the witness agree.
#pragma once

#include "reference/trace/trace.h"

#include <cstdint>
#include <optional>
#include <string>

namespace shadowproof {

/// A pixel at which truth and witness differ.
struct Disagreement {
    int x = 0;
    int y = 0;
    Visibility truth = Visibility::background;
    Visibility witness = Visibility::background;
    std::uint32_t truth_triangle = no_triangle;
    std::uint32_t witness_triangle = no_triangle;
};

struct Agreement {
    std::uint64_t asked = 0;     ///< pixels
    std::uint64_t undecided = 0; ///< of these, pixels that the truth's filters could not decide
    std::uint64_t disagreements = 0;
    std::optional<Disagreement> first{}; ///< by row, then column
};

/// Lets the witness decide pixels of the picture again. Half of them, or fewer if there are not so
/// many, are pixels that the truth's filters could not decide, evenly spread; the others are
/// random, but the same in every run. Takes time in proportion to pixels and triangles.
Agreement ask_witness(const Scene& scene, const GroundTruth& truth, std::uint64_t pixels,
                      int threads);

/// "64 pixels decided again by the witness, 12 of them undecided by filters: all agree".
std::string words_of(const Agreement& agreement);

} // namespace shadowproof
