// A light as JSON, for pixel records and the report's data.
#pragma once

#include "scenes/scene.h"

#include <nlohmann/json_fwd.hpp>

namespace shadowproof {

/// {"name", "kind": "point", "position"}; a spot has "direction" too, where it shines to, and a
/// directional light only that.
nlohmann::ordered_json light_json(const Light& light);

} // namespace shadowproof
