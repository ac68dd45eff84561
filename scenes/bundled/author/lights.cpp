#include "scenes/bundled/author/parts.h"
#include "scenes/bundled/author/stages.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <string>

namespace shadowproof::author {

namespace {

/// Eye and light are inside a ball of glass, which is not seen from within and yet casts: what lies
/// outside is dark, what lies inside is lit. No triangle of the glass faces the light: unflipped,
/// it has no volume.
Stage light_inside() {
    Stage stage = looking_along_floor("light_inside",
                                      "The light stands inside a closed ball that darkens all "
                                      "the world around it, and of which no triangle faces it.",
                                      {"far_plane", "light_inside"});
    stage.light.position = {-1.471, 7.377, 1.513};
    add(stage, {{.name = "glass",
                 .shape = ball(7.713, 4),
                 .color = {0.93, 0.95, 0.96},
                 .position = {0.413, 2.913, 7.313},
                 .turn_axis = {0.31, 0.83, 0.47},
                 .turn = 0.7331},
                {.name = "ball inside",
                 .shape = ball(0.613, 3),
                 .color = coral,
                 .position = {-0.871, 0.641, 1.971},
                 .turn_axis = {0.31, 0.83, 0.47},
                 .turn = 0.3331},
                {.name = "torus across",
                 .shape = torus(0.787, 0.313, 64, 24),
                 .color = teal,
                 .position = {1.413, 0.341, 0.471},
                 .turn_axis = {1, 0, 0},
                 .turn = 0.0213},
                {.name = "pillar outside",
                 .shape = disc(0.463, 0.817, 48),
                 .color = amber,
                 .position = {-1.413, 0.841, -1.713},
                 .turn = 0.171}});
    return stage;
}

/// A wedge along z: its slope runs from (x0, high) down to (x1, low), and it stands upright at x0.
Shape wedge(double x0, double high, double x1, double low, double half_depth) {
    Shape shape;
    for (const double z : {half_depth, -half_depth})
        for (const glm::dvec3& corner :
             {glm::dvec3(x0, high, z), glm::dvec3(x0, low, z), glm::dvec3(x1, low, z)})
            shape.vertices.push_back(corner);
    shape.triangles = {{0, 1, 2}, {3, 5, 4}, {0, 3, 4}, {0, 4, 1},
                       {1, 4, 5}, {1, 5, 2}, {2, 5, 3}, {2, 3, 0}};
    return shape;
}

/// The light is at (-2.5, 6.25, 0.75): in the plane of a side of the left box and of a side of the
/// back box, and of the slope of the ramp, which falls by 5/4 as it goes away from the light.
Stage light_in_plane() {
    Stage stage = looking_along_floor("light_in_plane",
                                      "The light lies exactly in the planes of a ramp's slope "
                                      "and of the sides of two boxes.");
    stage.light.position = {-2.5, 6.25, 0.75};
    add(stage, {{.name = "ramp",
                 .shape = wedge(1.5, 1.25, 2.4375, 0.078125, 0.875),
                 .color = amber,
                 .position = {0, 0, 1.875}},
                {.name = "left box",
                 .shape = box({0.625, 0.75, 0.5}, 4),
                 .color = slate,
                 .position = {-1.875, 0.78125, 2.0}},
                {.name = "back box",
                 .shape = box({0.5, 1.125, 0.625}, 4),
                 .color = teal,
                 .position = {0.3125, 1.15625, 0.125}},
                {.name = "ball",
                 .shape = ball(0.413, 3),
                 .color = coral,
                 .position = {0.413, 0.441, 2.371},
                 .turn_axis = {0.31, 0.83, 0.47},
                 .turn = 0.7331}});
    return stage;
}

const glm::dvec3 board_size(1.213, 0.113, 0.913); ///< half of it

/// A tilted board for a light to lie on.
Placed board(const glm::dvec3& turn_axis) {
    return {.name = "board",
            .shape = box(board_size, 1),
            .color = slate,
            .position = {-1.013, 2.913, 0.213},
            .turn_axis = glm::normalize(turn_axis),
            .turn = 1.113};
}

std::vector<Placed> around_board() {
    return {{.name = "ball",
             .shape = ball(0.513, 3),
             .color = coral,
             .position = {0.871, 0.541, 1.171},
             .turn_axis = {0.31, 0.83, 0.47},
             .turn = 0.7331},
            {.name = "torus",
             .shape = torus(0.687, 0.213, 64, 24),
             .color = teal,
             .position = {1.713, 0.241, -0.871},
             .turn_axis = {1, 0, 0},
             .turn = 0.0213},
            {.name = "pillar behind",
             .shape = disc(0.363, 0.817, 48),
             .color = amber,
             .position = {-3.113, 0.841, 0.713},
             .turn = 0.171}};
}

/// A point of a thing, given in its own axes.
glm::dvec3 placed(const Placed& thing, const glm::dvec3& point) {
    return thing.position + glm::angleAxis(thing.turn, thing.turn_axis) * point;
}

/// A lamp lies on one face of a tilted board: half of the world is behind that face, and dark. The
/// board's corners are floats, so the plane of the face is off by some 1e-7; the light is 4e-7
/// before it, less than float directions from the light can tell (scenes/mesh/touching_light.cpp).
Stage light_on_face() {
    Stage stage = looking_along_floor("light_on_face",
                                      "The light lies on a face of a closed board, as near as "
                                      "floats tell: all that is behind the face is dark.",
                                      {"far_plane", "extrusion"});
    const Placed thing = board({-0.13, 0.17, 0.97});
    stage.light.position = placed(thing, {0.313, -board_size.y - 4e-7, 0.271});
    add(stage, {thing});
    add(stage, around_board());
    return stage;
}

/// The same on an edge of the board, before one of its faces and behind the other: only the former
/// has a volume, which is bounded by a side over the edge that the light lies on. The eye is behind
/// it, in the dark.
Stage light_on_edge() {
    Stage stage = looking_along_floor("light_on_edge",
                                      "The light lies on an edge of a closed board, as near as "
                                      "floats tell, and the eye is in the dark behind it.",
                                      {"eye_inside", "extrusion", "range"});
    const Placed thing = board({0.05, 0.17, 0.97});
    stage.light.position = placed(thing, {0.313, -board_size.y - 4e-7, -board_size.z + 3e-7});
    add(stage, {thing});
    add(stage, around_board());
    return stage;
}

/// A light as low as a street lamp casts the shadows of posts down a runway, further than the
/// scene's bounding sphere reaches.
Stage long_shadow() {
    Stage stage = looking_along_floor("long_shadow",
                                      "Under a low light the shadows are longer than the radius "
                                      "of the scene.",
                                      {"extrusion"});
    constexpr double heading = 0.6131; // radians from the x axis towards -z
    const auto along = [&](double x, double y, double z) {
        return glm::dvec3(x * std::cos(heading) + z * std::sin(heading), y,
                          z * std::cos(heading) - x * std::sin(heading));
    };
    stage.things = {{.name = "runway",
                     .shape = box({8.513, 0.113, 2.213}, 3),
                     .color = sand,
                     .position = along(0, -0.113, 0),
                     .turn = heading}};
    add(stage, {{.name = "post",
                 .shape = disc(0.313, 0.713, 32),
                 .color = coral,
                 .position = along(-7.413, 0.737, -0.713),
                 .turn = 0.171},
                {.name = "ball",
                 .shape = ball(0.513, 3),
                 .color = teal,
                 .position = along(-6.871, 0.541, 0.813),
                 .turn_axis = {0.31, 0.83, 0.47},
                 .turn = 0.7331},
                {.name = "box",
                 .shape = box({0.413, 0.313, 0.413}, 3),
                 .color = slate,
                 .position = along(-1.613, 0.341, 0.613),
                 .turn = 0.3371}});
    stage.light.position = along(-12.871, 2.171, 0.171);
    stage.eye = {1.337, 13.273, 22.617};
    stage.target = {-0.913, -0.241, 0.513};
    stage.zfar = 413;
    return stage;
}

/// The still parts of a sundial.
void add_dial(Stage& stage) {
    add(stage, {{.name = "needle",
                 .shape = disc(0.171, 1.313, 32),
                 .color = coral,
                 .position = {0.071, 1.337, -0.113},
                 .turn_axis = {0.9, 0.1, -0.2},
                 .turn = 0.0713},
                {.name = "knob",
                 .shape = ball(0.413, 3),
                 .color = amber,
                 .position = {0.071, 3.013, 0.013},
                 .turn_axis = {0.31, 0.83, 0.47},
                 .turn = 0.7331}});
    constexpr int hours = 5;
    for (int i = 0; i < hours; ++i) {
        const double angle = 0.371 + 0.587 * i; // radians
        add(stage, {{.name = "hour " + std::to_string(i + 1),
                     .shape = box({0.213, 0.113 + 0.071 * (i % 3), 0.413}, 3),
                     .color = i % 2 == 0 ? slate : teal,
                     .position = {3.013 * std::cos(angle), 0.141 + 0.071 * (i % 3),
                                  3.013 * std::sin(angle)},
                     .turn = 1.571 - angle}});
    }
}

Stage moving_light() {
    Stage stage =
        looking_along_floor("moving_light", "The light goes over a sundial within four seconds; "
                                            "--time chooses when it is looked at.");
    add_dial(stage);
    stage.light.moves_to = glm::dvec3(3.871, 7.313, -1.971);
    return stage;
}

Stage many_lights() {
    Stage stage =
        looking_along_floor("many_lights", "Three lights over one sundial; --light chooses whose "
                                           "shadows are judged.");
    add_dial(stage);
    stage.light.name = "key";
    stage.more_lights = {
        {.name = "fill", .position = {4.171, 6.871, 2.313}, .intensity = 700, .moves_to = {}},
        {.name = "rim", .position = {0.713, 9.471, -3.871}, .intensity = 1100, .moves_to = {}}};
    return stage;
}

Stage sun() {
    Stage stage = looking_along_floor("sun", "A directional light over a sundial.");
    add_dial(stage);
    stage.light.name = "sun";
    stage.light.type = "directional";
    stage.light.intensity = 30; // lux
    return stage;
}

Stage spot() {
    Stage stage = looking_along_floor("spot", "A spot light: outside its cone no light arrives.");
    add_dial(stage);
    stage.light.name = "spot";
    stage.light.type = "spot";
    stage.light.target = {0.313, 0.171, 0.871};
    stage.light.outer_cone = 0.2871;
    return stage;
}

} // namespace

std::vector<Stage> stages_of_lights() {
    return {light_inside(), light_in_plane(), light_on_face(), light_on_edge(), long_shadow(),
            sun(),          spot(),           moving_light(),  many_lights()};
}

} // namespace shadowproof::author
