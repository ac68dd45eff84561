// The colours of the report's pictures. After Okabe and Ito (2008), "Color universal design", which
// stay apart under all common forms of colour blindness; the words beside them carry the meaning.
#pragma once

#include "compare/report/png.h"
#include "scenes/cause.h"
#include "scenes/frame.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace shadowproof {

/// One colour per cause, in the order of all_causes. Okabe and Ito have eight, so causes that no
/// technique has together share one.
inline constexpr std::array<Rgb, all_causes.size()> cause_colors{{
    {0x56, 0xB4, 0xE9}, // edge: sky blue
    {0xE6, 0x9F, 0x00}, // near_plane: orange
    {0x00, 0x9E, 0x73}, // far_plane: bluish green
    {0xCC, 0x79, 0xA7}, // eye_inside: reddish purple
    {0x00, 0x72, 0xB2}, // extrusion: blue
    {0xFF, 0xFF, 0xFF}, // cap: white
    {0x9A, 0x6A, 0xE0}, // counter: violet
    {0x9A, 0x6A, 0xE0}, // parity: violet, as a counter that only inverts cannot overflow
    {0xB8, 0xE0, 0xC8}, // open_mesh: pale green
    {0x00, 0x72,
     0xB2}, // light_inside: blue, as techniques whose volumes end flip casters around the light
    {0xA4, 0xD0, 0x1E}, // alpha: lime
    {0xE6, 0x9F, 0x00}, // resolution: orange
    {0xCC, 0x79, 0xA7}, // acne: reddish purple
    {0x00, 0x9E, 0x73}, // leak: bluish green
    {0xFF, 0xFF, 0xFF}, // range: white
    {0x9A, 0x6A, 0xE0}, // seam: violet, as maps have no counter
    {0x00, 0x72, 0xB2}, // filter: blue, as maps have no volume that ends
    {0x00, 0x72, 0xB2}, // missed: blue, as traced rays have no volume that ends
    {0xF0, 0xE4, 0x42}, // precision: yellow
    {0xFF, 0xFF, 0xFF}, // shading: white
    {0xD5, 0x5E, 0x00}, // unexplained: vermillion
}};

/// How a claim can contradict the truth.
enum class Contradiction : std::uint8_t {
    falsely_lit,
    falsely_shadowed,
    other_surface,
    partly_lit,
};

struct ContradictionWords {
    Contradiction contradiction;
    Rgb color;
    std::string_view name;
    std::string_view meaning;
};
inline constexpr std::array<ContradictionWords, 4> all_contradictions{{
    {Contradiction::falsely_lit,
     {0xE6, 0x9F, 0x00},
     "falsely lit",
     "claims light where there is shadow"},
    {Contradiction::falsely_shadowed,
     {0x56, 0xB4, 0xE9},
     "falsely shadowed",
     "claims shadow where there is light"},
    {Contradiction::other_surface,
     {0xCC, 0x79, 0xA7},
     "other surface",
     "one sees a surface, the other background"},
    {Contradiction::partly_lit,
     {0xF0, 0xE4, 0x42},
     "partly lit",
     "claims a share of the light where there is all of it or none"},
}};

/// How two different values contradict each other. If both see a surface, they disagree on the
/// light.
constexpr Contradiction contradiction(Visibility truth, Visibility claim) {
    if (truth == Visibility::background || claim == Visibility::background)
        return Contradiction::other_surface;
    if (claim == Visibility::partly_lit) return Contradiction::partly_lit;
    return claim == Visibility::lit ? Contradiction::falsely_lit : Contradiction::falsely_shadowed;
}

/// A palette's first colours: the claim where nothing differs.
enum Dimmed : std::uint8_t { dimmed_lit, dimmed_shadowed, dimmed_background, dimmed_count };

constexpr std::uint8_t dimmed_index(Visibility claim) {
    switch (claim) {
    case Visibility::lit:
        return dimmed_lit;
    case Visibility::partly_lit:
    case Visibility::shadowed:
        return dimmed_shadowed;
    case Visibility::background:
        break;
    }
    return dimmed_background;
}

/// The claim under the marks of difference and cause: dark enough that each mark stands out.
constexpr Rgb dimmed(Visibility claim) {
    switch (claim) {
    case Visibility::lit:
        return {88, 88, 92};
    case Visibility::partly_lit:
    case Visibility::shadowed:
        return {40, 40, 44};
    case Visibility::background:
        break;
    }
    return {16, 16, 20};
}

} // namespace shadowproof
