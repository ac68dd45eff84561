#include "scenes/load/common/override_view.h"

#include "scenes/error.h"
#include "scenes/load/common/default_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof {

namespace {

constexpr const char* flag = "--camera-matrix";

glm::dvec3 column(const std::array<double, 16>& matrix, std::size_t k) {
    return {matrix[4 * k], matrix[4 * k + 1], matrix[4 * k + 2]};
}

/// A camera has right angles: axes whose product is p are taken as if it were 0. That moves what is
/// seen by p times half the picture's side at most, so half a pixel in the largest picture.
/// Matrices that engines print in floats are off by less: 2 * sqrt(3) * 2^-24 for each rounding.
constexpr double most_product = 1.0 / largest_side;

void require_axes(const std::array<double, 16>& matrix) {
    const std::string remedy = "write the world matrix of the camera's node, column by column: "
                               "right 0, up 0, back 0, position 1";
    if (matrix[3] != 0 || matrix[7] != 0 || matrix[11] != 0)
        throw Error(flag, "has a translation in its last row: it is written row by row",
                    "transpose it; " + remedy);
    if (matrix[15] != 1)
        throw Error(flag, fmt::format("ends with {} instead of 1", matrix[15]), remedy);
    const glm::dvec3 right = glm::normalize(column(matrix, 0));
    const glm::dvec3 up = glm::normalize(column(matrix, 1));
    const glm::dvec3 back = glm::normalize(column(matrix, 2));
    const double mixed = glm::dot(glm::cross(right, up), back);
    if (!std::isfinite(mixed))
        throw Error(flag, "leaves the camera no direction", remedy + "; no axis may be zero");
    const double product = std::max({std::abs(glm::dot(right, up)), std::abs(glm::dot(up, back)),
                                     std::abs(glm::dot(back, right))});
    if (product > most_product)
        throw Error(flag,
                    fmt::format("has axes that are not at right angles (their product is "
                                "{:.3g})",
                                product),
                    "give it without the shear that a scaled parent node makes");
    if (mixed < 0)
        throw Error(flag, "mirrors: it is of an engine whose axes are left-handed",
                    "bring it to the file's axes; export-view prints how they go over");
}

void place_camera(const std::array<double, 16>& matrix, Camera& camera) {
    require_axes(matrix);
    camera.eye = column(matrix, 3);
    orient(camera, -column(matrix, 2), column(matrix, 1));
}

void place_light(const glm::dvec3& position, Scene& scene) {
    Light& light = scene.lights[scene.light];
    if (light.kind == Light::Kind::directional)
        throw Error("--light-position",
                    fmt::format("cannot move the light \"{}\", which is directional", light.name),
                    "choose another light with --light, or turn this one in the file");
    light.position = position;
}

} // namespace

void override_view(const ViewOverride& view, Scene& scene) {
    if (view.camera_matrix) {
        place_camera(*view.camera_matrix, scene.camera);
        scene.notes.emplace_back("the camera stands where --camera-matrix says");
    }
    if (view.vertical_field_of_view) {
        if (scene.camera.is_orthographic())
            throw Error("--fov", "is for a perspective camera, and this one is orthographic",
                        "leave it out, or choose another camera with --camera");
        scene.camera.half_height = std::tan(*view.vertical_field_of_view / 2);
        scene.notes.emplace_back("the field of view is that of --fov");
    }
    if (view.orthographic_height) {
        scene.camera.projection = Projection::orthographic;
        scene.camera.half_height = 0.5 * *view.orthographic_height;
        scene.notes.emplace_back("the camera is orthographic, its picture as high as --ortho says");
    }
    if (view.light_position) {
        place_light(*view.light_position, scene);
        scene.notes.emplace_back("the light stands where --light-position says");
    }
}

} // namespace shadowproof
