// The bundled scenes under each of their lights, by name.
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

/// All that load_named takes.
inline std::vector<std::string> bundled_names() {
    std::vector<std::string> names;
    for (const BundledScene& each : bundled_scenes()) {
        const std::string name(each.name);
        SceneRequest request;
        request.every_light = true;
        const Scene scene = load_scene(name, request);
        for (const Light& light : scene.lights)
            names.push_back(scene.lights.size() > 1 ? name + "-" + light.choice : name);
    }
    return names;
}

} // namespace shadowproof::tests
