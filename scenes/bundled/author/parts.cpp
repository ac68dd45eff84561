#include "scenes/bundled/author/parts.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace shadowproof::author {

Placed floor(double radius) {
    constexpr double half_height = 0.11;
    return {.name = "floor",
            .shape = disc(radius, half_height, 120),
            .color = sand,
            .position = {0.013, -half_height, -0.021},
            .turn = 0.0171};
}

Stage looking_along_floor(std::string name, std::string title, std::vector<std::string> provokes) {
    Stage stage;
    stage.name = std::move(name);
    stage.title = std::move(title);
    stage.provokes = std::move(provokes);
    stage.things = {floor(4.43)};
    stage.eye = {1.337, 5.273, 12.617};
    stage.target = {0.041, -0.241, 0.013};
    stage.yfov = 0.6137;
    stage.znear = 0.913;
    stage.zfar = 71.3;
    stage.light.position = {-3.471, 8.877, -0.683};
    return stage;
}

Stage lit_from_the_left(std::string name, std::string title) {
    Stage stage = looking_along_floor(std::move(name), std::move(title));
    stage.ambient = {0.11, 0.12, 0.14};
    stage.light.position = {-5.471, 8.877, 4.683};
    stage.target = {0.141, 1.041, 0.013};
    stage.yfov = 0.4237;
    stage.things[0].look.specular = glm::dvec3(0);
    return stage;
}

void add(Stage& stage, std::vector<Placed> things) {
    stage.things.insert(stage.things.end(), things.begin(), things.end());
}

Placed rod(std::string name, const glm::dvec3& from, const glm::dvec3& to, double radius,
           const glm::dvec3& color) {
    const glm::dvec3 along = glm::normalize(to - from);
    constexpr glm::dvec3 upright{0, 1, 0}; // as disc() stands
    return {.name = std::move(name),
            .shape = disc(radius, glm::distance(from, to) / 2, 24),
            .color = color,
            .position = (from + to) / 2.0,
            .turn_axis = glm::cross(upright, along),
            .turn = std::acos(along.y)};
}

glm::dvec3 above(const glm::dvec3& floor_point, double height, const glm::dvec3& light) {
    return glm::mix(floor_point, light, (height - floor_point.y) / (light.y - floor_point.y));
}

} // namespace shadowproof::author
