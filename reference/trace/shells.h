// The casters as closed and open shells, and which of their triangles a rule flips. Computed
// independently of the techniques (scenes/mesh/counted_casters.h), from the definitions: only the
// meanings of "equal positions" and "facing" are shared.
#pragma once

#include "reference/trace/trace.h"
#include "scenes/frame.h"
#include "scenes/scene.h"

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

namespace shadowproof {

/// A set of casters' triangles that are connected by shared edges.
struct Shell {
    std::size_t first = 0; ///< of Shells::triangles
    std::size_t count = 0;
    bool closed = true;       ///< no edge without a twin
    bool inverted = false;    ///< closed, and its volume is certainly negative
    bool holds_light = false; ///< closed, and the light is inside it or on it
};

struct Shells {
    std::vector<std::uint32_t> triangles; ///< shell by shell, in ascending order within each
    std::vector<Shell> all;

    std::span<const std::uint32_t> of(const Shell& shell) const {
        return std::span(triangles).subspan(shell.first, shell.count);
    }
};

/// Triangles with two equal corners have no area and are in no shell. O(n log n) time.
Shells find_shells(const Scene& scene);

/// Shells that are computed on first use, in any thread.
class LazyShells {
public:
    /// `scene` must be the same each time.
    const Shells& get(const Scene& scene) const {
        std::call_once(once_, [&] { shells_ = find_shells(scene); });
        return shells_;
    }

private:
    mutable std::once_flag once_;
    mutable Shells shells_;
};

/// One flag per triangle of the scene: flipped by this rule. Empty where none is.
std::vector<std::uint8_t> flipped_triangles(const Tracer& tracer, Counting::Flips flips);

/// Triangles that close all casters together: for each ring of edges without a twin, a fan from its
/// first corner. A ring begins at the first such edge in the order of the triangles. The walk goes
/// around the triangles at a corner to their other edge without a twin; where it returns to a
/// corner, the path since then is split off as a ring of its own.
std::vector<glm::uvec3> lids_of(const Scene& scene);

} // namespace shadowproof
