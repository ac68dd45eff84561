#include "scenes/bundled/author/parts.h"
#include "scenes/bundled/author/stages.h"
#include "scenes/bundled/author/textures.h"

namespace shadowproof::author {

namespace {

/// A screen and a tray of perforated sheet, closed boxes whose alpha masks leave round holes in
/// every face: light falls through both faces of the tray, and things are seen through the screen.
/// A ball in the tray's light and shadow, and a whole disc above, whose shadow falls through the
/// holes.
Stage perforated() {
    Stage stage = looking_along_floor("perforated",
                                      "Sheets whose alpha masks leave holes: shadow volumes know "
                                      "nothing of them.",
                                      {"alpha"});
    const Relief holes = [](double u, double v) { return 1 - bumps(5, 4)(u, v); };
    stage.textures = {{.name = "holes", .png = png_of(masked_color(40, 32, holes, sand))}};
    const Look sheet{.decal = 0, .cutoff = 0.4371};
    add(stage, {{.name = "tray",
                 .shape = textured_box({1.613, 0.0213, 1.213}, 2),
                 .color = teal,
                 .position = {-0.713, 1.913, -0.371},
                 .turn_axis = {0.21, 1, 0.13},
                 .turn = 0.4371,
                 .look = sheet},
                {.name = "screen",
                 .shape = textured_box({1.113, 0.813, 0.0313}, 2),
                 .color = coral,
                 .position = {1.413, 0.871, 1.713},
                 .turn_axis = {0, 1, 0},
                 .turn = -0.3713,
                 .look = sheet},
                {.name = "ball",
                 .shape = ball(0.613, 4),
                 .color = amber,
                 .position = {1.113, 0.671, 0.113},
                 .turn_axis = {0.31, 0.83, 0.47},
                 .turn = 0.7331},
                {.name = "disc",
                 .shape = disc(0.513, 0.0713, 64),
                 .color = slate,
                 .position = {-1.313, 3.071, -0.413},
                 .turn_axis = {0.3, 0.1, 1},
                 .turn = 0.213}});
    return stage;
}

} // namespace

std::vector<Stage> stages_of_masks() {
    return {perforated()};
}

} // namespace shadowproof::author
