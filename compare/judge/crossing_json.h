// Crossings of volume faces, triangles and vectors as JSON of schema shadowproof/pixel/1.
#pragma once

#include "reference/predict/ledger.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

namespace shadowproof {

nlohmann::ordered_json vector_json(const glm::dvec3& v);
nlohmann::ordered_json optional_json(const std::optional<double>& value); ///< null for none
/// Its number and mesh; null for no_triangle.
nlohmann::ordered_json triangle_json(const Scene& scene, std::uint32_t triangle);
nlohmann::ordered_json corners_json(const Scene& scene, std::uint32_t triangle);
/// `ends`: positions of the volumes' far ends; empty at infinity.
nlohmann::ordered_json crossing_json(const Scene& scene, const Crossing& crossing,
                                     const std::vector<glm::vec3>& ends);

} // namespace shadowproof
