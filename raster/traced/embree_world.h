// A scene in Embree, as applications commonly set it up: its triangles with the float vertices that
// go to OpenGL, default build and traversal, sixteen rays at a time. One setting is not the
// default: of the processor's instruction sets it uses SSE2 alone, so that each machine claims the
// same. Tests choose another by the environment variable SHADOWPROOF_TEST_TRACED_INSTRUCTION_SET
// (sse2, sse4.2, avx, avx2, avx512), to check that the judge's bounds hold for all of them.
#pragma once

#include "scenes/scene.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace shadowproof {

inline constexpr int traced_packet = 16;

/// Sixteen rays, and what they met.
struct FloatRays {
    template <class T>
    using Each = std::array<T, traced_packet>;

    alignas(64) Each<float> origin_x{}, origin_y{}, origin_z{};
    alignas(64) Each<float> direction_x{}, direction_y{}, direction_z{};
    alignas(64) Each<float> near{}, far{}; ///< a nearest hit's t takes the place of far
    alignas(64) Each<std::uint32_t> own{}; ///< a triangle that the ray passes through, or none
    Each<bool> valid{};
    Each<std::uint32_t> hit{}; ///< nearest, or some; no_triangle: none
};

/// The triangles, and which of them eye rays and shadow rays can meet. Keeps a reference to the
/// scene.
class EmbreeWorld {
public:
    /// Throws Error where Embree fails.
    explicit EmbreeWorld(const Scene& scene);
    ~EmbreeWorld();
    EmbreeWorld(const EmbreeWorld&) = delete;
    EmbreeWorld& operator=(const EmbreeWorld&) = delete;

    /// The nearest triangle that the eye can see: materials of one side are not seen from behind.
    void find_nearest(FloatRays& rays) const;
    /// Any triangle that casts, other than the ray's own.
    void find_any(FloatRays& rays) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Embree refuses rays (and drops triangles) with larger coordinates.
inline constexpr float embree_largest = 1.844e18F;

} // namespace shadowproof
