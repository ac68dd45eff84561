#include "scenes/engines/engine_code.h"

#include "scenes/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/trigonometric.hpp>

namespace shadowproof {

namespace {

using Lines = std::vector<std::string>;

/// A number of a language whose floats end with a letter: "f" in C#, "" elsewhere.
std::string joined(const glm::dvec3& v, const char* letter = "") {
    return fmt::format("{0}{3}, {1}{3}, {2}{3}", v.x, v.y, v.z, letter);
}

/// x, y, z, w.
std::string joined(const glm::dquat& q, const char* letter = "") {
    return fmt::format("{0}{4}, {1}{4}, {2}{4}, {3}{4}", q.x, q.y, q.z, q.w, letter);
}

double aspect(const Scene& scene) {
    return static_cast<double>(scene.camera.width) / scene.camera.height;
}

bool turns(const Scene& scene) {
    return chosen_light(scene).kind != Light::Kind::point;
}

Lines three(const Scene& scene, const EngineView& view) {
    const std::string made =
        view.extent ? fmt::format("camera = new THREE.OrthographicCamera({}, {}, {}, {}, {}, {});",
                                  -view.extent->x / 2, view.extent->x / 2, view.extent->y / 2,
                                  -view.extent->y / 2, view.near, *view.far)
                    : fmt::format("camera = new THREE.PerspectiveCamera({}, {}, {}, {});",
                                  glm::degrees(view.vertical_field_of_view), aspect(scene),
                                  view.near, *view.far);
    Lines lines{made, fmt::format("camera.position.set({});", joined(view.position)),
                fmt::format("camera.quaternion.set({});", joined(view.rotation)),
                fmt::format("light.position.set({});", joined(view.light_position))};
    if (turns(scene))
        lines.push_back(fmt::format("light.target.position.set({}); scene.add(light.target);",
                                    joined(view.light_position + view.light_direction)));
    return lines;
}

Lines babylon(const Scene& scene, const EngineView& view) {
    Lines lines{
        fmt::format("camera = new BABYLON.FreeCamera('view', new BABYLON.Vector3({}), "
                    "scene);",
                    joined(view.position)),
        fmt::format("camera.rotationQuaternion = new BABYLON.Quaternion({});",
                    joined(view.rotation)),
        view.extent
            ? fmt::format("camera.mode = BABYLON.Camera.ORTHOGRAPHIC_CAMERA; camera.orthoLeft = "
                          "{}; camera.orthoRight = {}; camera.orthoBottom = {}; camera.orthoTop = "
                          "{};",
                          -view.extent->x / 2, view.extent->x / 2, -view.extent->y / 2,
                          view.extent->y / 2)
            : fmt::format("camera.fov = {};", view.vertical_field_of_view),
        fmt::format("camera.minZ = {}; camera.maxZ = {};", view.near, *view.far),
        "scene.activeCamera = camera;",
        fmt::format("light.position = new BABYLON.Vector3({});", joined(view.light_position))};
    if (turns(scene))
        lines.push_back(fmt::format("light.direction = new BABYLON.Vector3({});",
                                    joined(view.light_direction)));
    return lines;
}

Lines godot(const Scene& scene, const EngineView& view) {
    const auto transform = [](const glm::dquat& rotation, const glm::dvec3& position) {
        return fmt::format("Transform3D(Basis(Quaternion({})), Vector3({}))", joined(rotation),
                           joined(position));
    };
    Lines lines{
        "camera.global_transform = " + transform(view.rotation, view.position),
        "camera.keep_aspect = Camera3D.KEEP_HEIGHT",
        view.extent ? fmt::format("camera.projection = Camera3D.PROJECTION_ORTHOGONAL; camera.size "
                                  "= {}",
                                  view.extent->y)
                    : fmt::format("camera.fov = {}", glm::degrees(view.vertical_field_of_view)),
        fmt::format("camera.near = {}", view.near), fmt::format("camera.far = {}", *view.far)};
    lines.push_back(
        turns(scene)
            ? "light.global_transform = " + transform(view.light_rotation, view.light_position)
            : fmt::format("light.global_position = Vector3({})", joined(view.light_position)));
    return lines;
}

std::string blender_matrix(const glm::dmat4& matrix) {
    std::string rows;
    for (int row = 0; row < 4; ++row)
        rows += fmt::format("{}({}, {}, {}, {})", row == 0 ? "" : ", ", matrix[0][row],
                            matrix[1][row], matrix[2][row], matrix[3][row]);
    return fmt::format("mathutils.Matrix(({}))", rows);
}

Lines blender(const Scene& scene, const EngineView& view) {
    Lines lines{
        "camera.matrix_world = " + blender_matrix(view.world_from_camera),
        "camera.data.sensor_fit = 'VERTICAL'",
        view.extent ? fmt::format("camera.data.type = 'ORTHO'; camera.data.ortho_scale = {}",
                                  view.extent->y)
                    : fmt::format("camera.data.angle = {}", view.vertical_field_of_view),
        fmt::format("camera.data.clip_start = {}; camera.data.clip_end = {}", view.near, *view.far),
        fmt::format("bpy.context.scene.render.resolution_x = {}", scene.camera.width),
        fmt::format("bpy.context.scene.render.resolution_y = {}", scene.camera.height)};
    glm::dmat4 light = turns(scene) ? glm::mat4_cast(view.light_rotation) : glm::dmat4(1);
    light[3] = glm::dvec4(view.light_position, 1);
    lines.push_back("light.matrix_world = " + blender_matrix(light));
    return lines;
}

Lines ogre(const Scene& scene, const EngineView& view) {
    const auto orientation = [](const glm::dquat& q) {
        return fmt::format("Ogre::Quaternion({}, {}, {}, {})", q.w, q.x, q.y, q.z);
    };
    Lines lines{fmt::format("cameraNode->setPosition({});", joined(view.position)),
                fmt::format("cameraNode->setOrientation({});", orientation(view.rotation)),
                view.extent
                    ? fmt::format("camera->setProjectionType(Ogre::PT_ORTHOGRAPHIC); "
                                  "camera->setOrthoWindow({}, {});",
                                  view.extent->x, view.extent->y)
                    : fmt::format("camera->setFOVy(Ogre::Radian({})); camera->setAspectRatio({});",
                                  view.vertical_field_of_view, aspect(scene)),
                fmt::format("camera->setNearClipDistance({});", view.near),
                fmt::format("camera->setFarClipDistance({});", view.far.value_or(0)),
                fmt::format("lightNode->setPosition({});", joined(view.light_position))};
    if (turns(scene))
        lines.push_back(
            fmt::format("lightNode->setOrientation({});", orientation(view.light_rotation)));
    return lines;
}

Lines unity(const Scene& scene, const EngineView& view) {
    const auto pose = [](const char* what, const glm::dvec3& at, const glm::dquat& rotation) {
        return fmt::format("{}.transform.SetPositionAndRotation(new Vector3({}), "
                           "new Quaternion({}));",
                           what, joined(at, "f"), joined(rotation, "f"));
    };
    Lines lines{pose("camera", view.position, view.rotation),
                view.extent ? fmt::format("camera.orthographic = true; camera.orthographicSize = "
                                          "{}f;",
                                          view.extent->y / 2)
                            : fmt::format("camera.fieldOfView = {}f;",
                                          glm::degrees(view.vertical_field_of_view)),
                fmt::format("camera.aspect = {}f;", aspect(scene)),
                fmt::format("camera.nearClipPlane = {}f; camera.farClipPlane = {}f;", view.near,
                            *view.far)};
    lines.push_back(turns(scene) ? pose("light", view.light_position, view.light_rotation)
                                 : fmt::format("light.transform.position = new Vector3({});",
                                               joined(view.light_position, "f")));
    return lines;
}

Lines unreal(const Scene& scene, const EngineView& view) {
    const auto pose = [](const char* what, const glm::dvec3& at, const glm::dquat& rotation) {
        return fmt::format("{}->SetWorldLocationAndRotation(FVector({}), FRotator({}));", what,
                           joined(at), joined(unreal_rotator(rotation)));
    };
    Lines lines{
        pose("camera", view.position, view.rotation),
        view.extent ? fmt::format("camera->SetProjectionMode(ECameraProjectionMode::Orthographic); "
                                  "camera->SetOrthoWidth({});",
                                  view.extent->x)
                    : fmt::format("camera->SetFieldOfView({});",
                                  glm::degrees(view.horizontal_field_of_view)),
        fmt::format("camera->SetAspectRatio({}); camera->SetConstraintAspectRatio(true);",
                    aspect(scene)),
        view.extent
            ? fmt::format("camera->SetOrthoNearClipPlane({}); camera->SetOrthoFarClipPlane({});",
                          view.near, *view.far)
            : fmt::format("GEngine->Exec(GetWorld(), TEXT(\"r.SetNearClipPlane {}\"));",
                          view.near)};
    lines.push_back(turns(scene) ? pose("light", view.light_position, view.light_rotation)
                                 : fmt::format("light->SetWorldLocation(FVector({}));",
                                               joined(view.light_position)));
    return lines;
}

} // namespace

std::vector<std::string> engine_code(const Convention& convention, const Scene& scene,
                                     const EngineView& view) {
    if (convention.name == "three") return three(scene, view);
    if (convention.name == "babylon") return babylon(scene, view);
    if (convention.name == "godot") return godot(scene, view);
    if (convention.name == "blender") return blender(scene, view);
    if (convention.name == "ogre") return ogre(scene, view);
    if (convention.name == "unity") return unity(scene, view);
    assert(convention.name == "unreal");
    return unreal(scene, view);
}

glm::dvec3 unreal_rotator(const glm::dquat& rotation) {
    const glm::dmat3 axes = glm::mat3_cast(rotation);
    const glm::dvec3& forward = axes[0];
    const double level = std::hypot(forward.x, forward.y);
    const double pitch = std::atan2(forward.z, level);
    // Straight up or down, yaw and roll turn about one axis: roll is left at 0 and yaw does it all.
    const double yaw =
        level > 0 ? std::atan2(forward.y, forward.x) : std::atan2(-axes[1].x, axes[1].y);
    // Where y and z would be without roll, y is level.
    const glm::dvec3 level_right{-std::sin(yaw), std::cos(yaw), 0};
    const double roll = std::atan2(glm::dot(axes[2], level_right), glm::dot(axes[1], level_right));
    return glm::degrees(glm::dvec3(pitch, yaw, roll));
}

} // namespace shadowproof
