// A stage (placed shapes, one camera, one point light) to the text of a .gltf with an embedded
// buffer. The same stage gives the same bytes.
#pragma once

#include "scenes/bundled/author/shapes.h"

#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace shadowproof::author {

struct Placed {
    std::string name;
    Shape shape;
    glm::dvec3 color{0.8, 0.8, 0.8}; ///< linear base colour
    glm::dvec3 position{0, 0, 0};
    glm::dvec3 turn_axis{0, 1, 0};
    double turn = 0; ///< radians about turn_axis
};

struct Stage {
    std::string name;
    std::string title;                 ///< for asset.extras, one sentence
    std::vector<std::string> provokes; ///< cause names
    std::vector<Placed> things;
    glm::dvec3 eye{0, 0, 5};
    glm::dvec3 target{0, 0, 0};
    double yfov = 0.6; ///< radians
    double znear = 0.5;
    double zfar = 100;
    glm::dvec3 light{0, 10, 0};
    double candela = 2000;
};

std::string write_gltf(const Stage& stage);

} // namespace shadowproof::author
