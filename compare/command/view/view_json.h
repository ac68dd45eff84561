// A scene's camera and light in other engines' conventions, as JSON: "shadowproof/view/1".
#pragma once

#include "scenes/engines/convention.h"
#include "scenes/scene.h"

#include <nlohmann/json.hpp>
#include <vector>

namespace shadowproof {

/// `scene`: in the file's units. `time`: seconds at which it is posed. `engines`: from
/// conventions(); empty: all.
nlohmann::ordered_json view_json(const Scene& scene, double time,
                                 const std::vector<const Convention*>& engines);

} // namespace shadowproof
