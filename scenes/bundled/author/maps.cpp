#include "scenes/bundled/author/parts.h"
#include "scenes/bundled/author/stages.h"

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace shadowproof::author {

namespace {

/// A plate that hovers above the floor by less than the customary bias of 0.15, and things that
/// stand on it: their shadows begin too far away, or are not there at all.
Stage thin_caster() {
    Stage stage = looking_along_floor("thin_caster",
                                      "A thin plate closely above the floor, and things that stand "
                                      "on it: a bias lets their shadows begin too far away.",
                                      {"leak"});
    add(stage,
        {{"plate", disc(1.313, 0.0071, 96), teal, {-1.313, 0.0613, 0.413}},
         {"case", box({0.613, 0.413, 0.513}, 5), slate, {1.613, 0.4141, -0.813}, {0, 1, 0}, 0.4371},
         {"coin", disc(0.513, 0.043, 64), coral, {0.813, 0.0433, 1.671}, {0, 1, 0}, 0.171}});
    return stage;
}

/// The light hangs low amid posts. Seen from it, their shadows run over the edges of a cube around
/// it.
Stage cube_edge() {
    Stage stage = looking_along_floor("cube_edge",
                                      "A light amid posts, whose shadows run over the edges of "
                                      "the light's cube.",
                                      {"resolution"});
    stage.light.position = {0.213, 3.613, -0.171};
    constexpr int posts = 9;
    for (int i = 0; i < posts; ++i) {
        const double angle = 0.213 + 2 * std::numbers::pi * i / posts;
        const double away = 1.813 + 0.0713 * i;
        const double height = 1.113 + 0.0671 * i;
        add(stage,
            {{"post " + std::to_string(i),
              box({0.0713, height / 2, 0.0913}, 5),
              i % 2 == 0 ? coral : teal,
              {0.213 + away * std::cos(angle), 0.011 + height / 2, -0.171 + away * std::sin(angle)},
              {0, 1, 0},
              0.371 * i}});
    }
    return stage;
}

/// Seen from the light, a whole peg is smaller than a texel of a map of 1024.
Stage far_light() {
    Stage stage = looking_along_floor("far_light",
                                      "Small pegs under a light that is far away: the texels of "
                                      "its map are larger than they.",
                                      {"resolution"});
    stage.light.position *= 31.3;
    constexpr int pegs = 7;
    for (int i = 0; i < pegs; ++i) {
        const double angle = 0.413 + 0.897 * i;
        const double away = 0.813 + 0.3713 * i;
        add(stage, {{"peg " + std::to_string(i),
                     box({0.0913, 0.313, 0.0713}, 5),
                     i % 2 == 0 ? amber : slate,
                     {away * std::cos(angle), 0.3171, away * std::sin(angle)},
                     {0, 1, 0},
                     0.613 * i}});
    }
    return stage;
}

/// The light grazes the floor: what one texel sees reaches from well before a point to well behind
/// it.
Stage low_light() {
    Stage stage = looking_along_floor("low_light",
                                      "A light that grazes the floor: a texel's surface is steep, "
                                      "and shadows itself.",
                                      {"acne"});
    stage.light.position = {-13.471, 0.671, -0.683};
    add(stage,
        {{"ring", torus(0.387, 0.113, 64, 24), amber, {-0.713, 0.115, 1.243}, {1, 0, 0}, 0.0031},
         {"puck", disc(0.313, 0.0513, 48), coral, {0.813, 0.0523, -0.671}, {0, 1, 0}, 0.171}});
    return stage;
}

/// The light's range ends amid the floor, and with it a map whose far plane lies there.
Stage light_range() {
    Stage stage = looking_along_floor("light_range",
                                      "A light whose range ends amid what it lights: a map that "
                                      "reaches no further has no answer beyond.",
                                      {"range"});
    stage.light.range = 10.313;
    add(stage,
        {{"near case",
          box({0.413, 0.613, 0.373}, 5),
          teal,
          {-1.713, 0.6141, 0.813},
          {0, 1, 0},
          0.4371},
         {"ring", torus(0.513, 0.171, 64, 24), amber, {0.313, 0.1713, -1.413}, {1, 0, 0}, 0.0031},
         {"far case",
          box({0.373, 0.513, 0.413}, 5),
          coral,
          {2.613, 0.5141, 0.471},
          {0, 1, 0},
          0.871}});
    return stage;
}

/// Two wires pass the light more closely than a map's near plane, 2^-14 of the way to the floor.
/// Two sides of a volume that begin so close to the light part fast: they pass the far plane, and
/// what is extruded to a finite length ends early.
Stage near_light() {
    Stage stage = looking_along_floor("near_light",
                                      "Wires that pass the light closely: a map's near plane cuts "
                                      "them away, and their shadows with them.",
                                      {"range", "far_plane", "extrusion"});
    const glm::dvec3 light = stage.light.position;
    const auto wire = [&](std::string name, double below, const glm::dvec3& along) {
        const glm::dvec3 middle = light - glm::dvec3(0, below, 0);
        return rod(std::move(name), middle - along, middle + along, 0.000031, slate);
    };
    add(stage,
        {wire("wire", 0.000413, {0.00213, 0.0000713, 0.000171}),
         wire("wire across", 0.000571, {-0.000313, 0.0000371, 0.00187}),
         {"puck", disc(0.613, 0.213, 48), coral, {0.813, 0.2143, -0.671}, {0, 1, 0}, 0.171}});
    return stage;
}

} // namespace

std::vector<Stage> stages_of_maps() {
    return {thin_caster(), cube_edge(), far_light(), low_light(), light_range(), near_light()};
}

} // namespace shadowproof::author
