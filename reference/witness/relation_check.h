// Whether the truth stays the same where the scene is changed in ways that must not change its
// picture (scenes/relations), and whether two points see each other from either end.
#pragma once

#include "reference/trace/trace.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace shadowproof {

struct RelationCheck {
    std::vector<std::string> tried{};
    std::vector<std::string> left_out{}; ///< not exact for the scene's numbers
    std::uint64_t compared = 0;          ///< pixels, of all relations together
    /// Of these, pixels with another answer though a tie was met: which of two triangles at the
    /// same place is seen depends on their order.
    std::uint64_t ties = 0;
    std::uint64_t changed = 0; ///< pixels with another answer and no tie
    std::string first{};       ///< of these, in words; empty where there are none
};

/// Traces the scene anew for each relation, and compares classes and triangles with its truth.
RelationCheck check_relations(const Scene& scene, const GroundTruth& truth, int threads);

/// Whether a light at b reaches a, and whether a light at a reaches b, past all casters; the two
/// must be equal. None where this cannot be decided exactly, or where a triangle lies so near to
/// one of the points that it would be seen instead.
std::optional<std::array<bool, 2>> mutual_visibility(const Scene& scene, const glm::vec3& a,
                                                     const glm::vec3& b);

/// "the truth stays the same in 9 relations, at 230,400 pixels".
std::string words_of(const RelationCheck& check);

} // namespace shadowproof
