#include "scenes/bundled/author/parts.h"
#include "scenes/bundled/author/stages.h"

namespace shadowproof::author {

namespace {

/// The stage in other units: nothing of the picture changes but how its numbers are rounded, and
/// what a constant of a length amounts to.
Stage in_units(Stage stage, double unit) {
    for (Placed& thing : stage.things) {
        thing.position *= unit;
        for (glm::dvec3& vertex : thing.shape.vertices) vertex *= unit;
    }
    stage.eye *= unit;
    stage.target *= unit;
    stage.light.position *= unit;
    stage.znear *= unit;
    stage.zfar *= unit;
    return stage;
}

std::vector<Placed> desk() {
    return {{"case", box({1.13, 0.43, 0.61}, 5), slate, {-1.217, 0.431, -0.793}, {0, 1, 0}, 0.4371},
            {"ring", torus(0.687, 0.213, 88, 32), amber, {0.713, 0.215, 1.243}, {1, 0, 0}, 0.0031},
            {"pearl", ball(0.817, 4), teal, {1.553, 0.819, -0.671}, {0.31, 0.83, 0.47}, 0.7331},
            {"coin", disc(0.513, 0.043, 64), coral, {-1.113, 0.047, 1.371}, {0, 1, 0}, 0.171}};
}

/// A floor nine centimetres wide, in metres: a thousandth is a millimetre, and what touches the
/// floor casts no shadow on it that near.
Stage in_metres() {
    Stage stage = looking_along_floor("in_metres",
                                      "Small things in metres: an epsilon of 1e-3 is a "
                                      "millimetre, and shadows near their casters leak.",
                                      {"leak"});
    add(stage, desk());
    return in_units(std::move(stage), 0.01);
}

/// A floor nine metres wide, in millimetres: floats of such size are further apart than a
/// thousandth.
Stage in_millimetres() {
    Stage stage = looking_along_floor("in_millimetres",
                                      "A room in millimetres: floats round hit points by more "
                                      "than an epsilon of 1e-3, and surfaces shadow themselves.",
                                      {"acne"});
    add(stage, desk());
    return in_units(std::move(stage), 1000);
}

/// Round pillars whose sides are slivers some hundred times as long as they are wide, seen from
/// afar through a long lens: floats round the way from the eye by much more than things of this
/// size would need, and a ray that passes an edge as near as that may be outside of both triangles
/// there.
Stage slivers() {
    Stage stage = looking_along_floor("slivers",
                                      "Pillars of slivers seen from afar: float rays slip through "
                                      "between them.",
                                      {"missed"});
    constexpr double away = 41.3; // times as far as in other scenes
    stage.eye = stage.target + away * (stage.eye - stage.target);
    stage.yfov /= away;
    stage.znear = 513;
    stage.zfar = 713;
    constexpr unsigned sides = 1024;
    add(stage, {{"left pillar",
                 disc(0.913, 1.313, sides),
                 slate,
                 {-1.413, 1.357, -0.213},
                 {0.31, 0.23, 0.47},
                 0.0931},
                {"right pillar",
                 disc(0.713, 0.913, sides),
                 coral,
                 {1.513, 0.957, 0.671},
                 {-0.31, 0.13, 0.27},
                 0.1331}});
    return stage;
}

} // namespace

std::vector<Stage> stages_of_rays() {
    return {in_metres(), in_millimetres(), slivers()};
}

} // namespace shadowproof::author
