// Bundled scenes, each traced once in a process, for tests that ask for the same ones again.
#pragma once

#include "tests/compare/traced_scene.h"
#include "tests/scenes/bundled_names.h"

#include <map>
#include <memory>
#include <string>

namespace shadowproof::tests {

/// `name`: as load_named takes it.
inline const TracedScene& traced_bundled(const std::string& name) {
    static std::map<std::string, std::unique_ptr<TracedScene>> scenes;
    std::unique_ptr<TracedScene>& scene = scenes[name];
    if (!scene) scene = std::make_unique<TracedScene>(load_named(name));
    return *scene;
}

} // namespace shadowproof::tests
