// Scenes made at random: closed bodies, convex and concave, and open soups; eye and light anywhere,
// also inside, on and next to them; near and far planes that cut.
#pragma once

#include "scenes/scene.h"
#include "tests/dice.h"

namespace shadowproof::tests {

/// What else than usual may come.
struct Oddities {
    bool eyes_on_casters = false; ///< on vertices, edges and faces, or an ulp from there
    bool bodies_on_quarters =
        false;                 ///< as soups are: the light may lie in the planes of many faces
    bool orthographic = false; ///< lines of sight are parallel
    int scale = 1;             ///< of the picture: so many times 24x20 pixels
};

/// Its name says in words what it is. It declares nothing.
Scene random_scene(Dice& dice, const Oddities& oddities);

} // namespace shadowproof::tests
