// The names of the bundled scenes, by kind. No file is read for them: googletest asks for the names
// in each process, of which every test is one. bundled_test.cpp holds them to what the files say.
#pragma once

#include "scenes/load/catalog.h"
#include "scenes/scene.h"

#include <string>
#include <vector>

namespace shadowproof::tests {

/// A bundled name, or that and a light's: "many_lights-fill".
inline Scene load_named(const std::string& name) {
    const std::size_t dash = name.find('-');
    SceneRequest request;
    if (dash != std::string::npos) request.light = name.substr(dash + 1);
    return load_scene(name.substr(0, dash), request);
}

/// Every bundled scene, once.
inline std::vector<std::string> bundled_scene_names() {
    std::vector<std::string> names;
    for (const BundledScene& scene : bundled_scenes()) names.emplace_back(scene.name);
    return names;
}

/// All that load_named takes: every bundled scene under each of its lights.
inline std::vector<std::string> bundled_names() {
    std::vector<std::string> names;
    for (const std::string& name : bundled_scene_names())
        if (name == "many_lights")
            names.insert(names.end(), {name + "-key", name + "-fill", name + "-rim"});
        else if (name == "bumpy_lights")
            names.insert(names.end(), {name + "-key", name + "-spot"});
        else
            names.push_back(name);
    return names;
}

/// Those that are lit by bump maps.
inline std::vector<std::string> bump_lit_scenes() {
    return {"bumpy_sphere",     "bumpy_torus",          "mirrored_skin",    "height_field",
            "stretched_relief", "skewed_relief",        "hammered_silver",  "coarse_curve",
            "grazing_light",    "terminator_highlight", "fine_relief",      "bright_light",
            "bumpy_near_plane", "bumpy_far_plane",      "bumpy_eye_inside", "bumpy_lights",
            "distant_bumps",    "walking_figure"};
}

} // namespace shadowproof::tests
