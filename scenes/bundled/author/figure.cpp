#include "scenes/bundled/author/parts.h"
#include "scenes/bundled/author/textures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>

namespace shadowproof::author {

namespace {

// The figure looks along +z and its left is +x; lengths are in units of the scene. It is modelled
// around its root, which is on the floor.
constexpr double stride_seconds = 2; // both legs
constexpr double hip_height = 1.713;
constexpr double thigh = 0.813; // hip to knee
constexpr double shin = 0.771;  // knee to ankle
constexpr glm::dvec3 foot_radii{0.137, 0.113, 0.283};
constexpr double foot_ahead = 0.113; // of the ankle

/// Rotated about x, so that what hangs swings ahead.
glm::dvec3 swung(const glm::dvec3& point, const glm::dvec3& about, double angle) {
    const glm::dvec3 arm = point - about;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return about + glm::dvec3(arm.x, c * arm.y + s * arm.z, c * arm.z - s * arm.y);
}

glm::dvec3 twisted(const glm::dvec3& point, double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {c * point.x + s * point.z, point.y, c * point.z - s * point.x};
}

double smooth(double low, double high, double x) {
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

using Deformation = std::function<glm::dvec3(const glm::dvec3&)>;

/// The morph target of a shape whose every point moves as `deform` says: its normals and tangents
/// are transformed by the derivative.
Morph posed(const Shape& shape, const Deformation& deform) {
    constexpr double step = 0x1p-12; // each way; errors are of its square
    Morph morph;
    for (std::size_t i = 0; i < shape.vertices.size(); ++i) {
        const glm::dvec3& point = shape.vertices[i];
        morph.vertices.push_back(deform(point) - point);
        glm::dmat3 turned;
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 way(0);
            way[axis] = step;
            turned[axis] = (deform(point + way) - deform(point - way)) / (2 * step);
        }
        const glm::dvec3 normal = shape.normals[i];
        morph.normals.push_back(glm::normalize(glm::transpose(glm::inverse(turned)) * normal) -
                                normal);
        if (shape.tangents.empty()) continue;
        const glm::dvec3 tangent(shape.tangents[i]);
        morph.tangents.push_back(glm::normalize(turned * tangent) - tangent);
    }
    return morph;
}

/// The whole trunk with the head, around the hips' joint.
Shape trunk() {
    return textured_lathe({{0, 2.071},
                           {0.271, 1.971},
                           {0.371, 1.713},
                           {0.313, 1.513},
                           {0.171, 1.371},
                           {0.213, 1.271},
                           {0.471, 1.113},
                           {0.513, 0.913},
                           {0.413, 0.613},
                           {0.371, 0.313},
                           {0.413, 0.013},
                           {0.271, -0.213},
                           {0, -0.271}},
                          0.813, 16, Wearing::mirrored, {3, 5});
}

/// Shoulders rotate against the hips; the head keeps looking ahead.
double twist_at(double height, double most) {
    return most * (smooth(0, 0.871, height) - smooth(1.171, 1.513, height));
}

constexpr glm::dvec3 shoulder{0.571, 0.971, 0}; // the left, from the hips' joint

Shape left_arm() {
    const std::vector<Ring> rings{
        {0, 0.171},      {0.137, 0.113},  {0.171, 0},      {0.153, -0.313}, {0.131, -0.513},
        {0.137, -0.713}, {0.101, -0.971}, {0.131, -1.113}, {0.101, -1.213}, {0, -1.271}};
    return moved(textured_lathe(rings, 1, 9, Wearing::around, {1, 3}), shoulder);
}

/// An arm swung from the shoulder, the elbow bent as it swings ahead, and rotated with the
/// shoulders.
Deformation arm_swing(double angle, double bend, double twist) {
    constexpr glm::dvec3 elbow = shoulder + glm::dvec3(0, -0.571, 0);
    return [=](const glm::dvec3& point) {
        const double below = smooth(elbow.y + 0.171, elbow.y - 0.171, point.y);
        const double upper = smooth(shoulder.y + 0.213, shoulder.y - 0.213, point.y);
        const glm::dvec3 bent = swung(point, elbow, bend * below);
        return twisted(swung(bent, shoulder, angle * (0.713 + 0.287 * upper)), twist);
    };
}

/// Both arms, the left one swung by `ahead` and the right one by the same the other way.
Morph arms_posed(const Shape& left, double ahead, double twist) {
    const auto swing = [&](double angle, double turn) {
        return posed(left, arm_swing(angle, angle > 0 ? 0.713 : 0.213, turn));
    };
    Morph both = swing(ahead, twist);
    const Morph right = swing(-ahead, -twist); // then mirrored
    const auto mirror = [](std::vector<glm::dvec3>& to, const std::vector<glm::dvec3>& from) {
        for (const glm::dvec3& way : from) to.emplace_back(-way.x, way.y, way.z);
    };
    mirror(both.vertices, right.vertices);
    mirror(both.normals, right.normals);
    mirror(both.tangents, right.tangents);
    return both;
}

enum JointNumber : unsigned { root, hips, left_thigh, left_shin, right_thigh, right_shin };

constexpr double hip_apart = 0.213; // from the middle

Shape left_leg() {
    const double knee = hip_height - thigh;
    const double ankle = knee - shin;
    const std::vector<Ring> rings{
        {0, hip_height + 0.213},     {0.171, hip_height + 0.137}, {0.213, hip_height},
        {0.201, hip_height - 0.371}, {0.171, knee + 0.171},       {0.163, knee},
        {0.171, knee - 0.171},       {0.163, knee - 0.371},       {0.113, ankle + 0.113},
        {0.087, ankle - 0.031},      {0, ankle - 0.071}};
    return moved(textured_lathe(rings, 1, 10, Wearing::around, {1, 4}), {hip_apart, 0, 0});
}

Shape left_foot() {
    Shape foot = textured_lathe(capsule(1, 0, 3), 1, 10, Wearing::around, {1, 1});
    for (std::size_t i = 0; i < foot.vertices.size(); ++i) {
        foot.vertices[i] *= foot_radii;
        foot.normals[i] = glm::normalize(foot.normals[i] / foot_radii);
        const glm::dvec3 tangent = glm::dvec3(foot.tangents[i]) * foot_radii;
        foot.tangents[i] = glm::dvec4(glm::normalize(tangent), foot.tangents[i].w);
    }
    return moved(foot, {hip_apart, hip_height - thigh - shin, foot_ahead});
}

/// Around the knee the weights pass from the thigh to the shin.
std::vector<Influence> leg_influences(const Shape& legs) {
    constexpr double knee = hip_height - thigh;
    std::vector<Influence> influences;
    for (const glm::dvec3& vertex : legs.vertices) {
        const double of_shin = smooth(knee + 0.213, knee - 0.213, vertex.y);
        const unsigned upper = vertex.x > 0 ? left_thigh : right_thigh;
        const unsigned lower = vertex.x > 0 ? left_shin : right_shin;
        if (of_shin == 0 || of_shin == 1)
            influences.push_back({{of_shin == 0 ? upper : lower, 0, 0, 0}, {1, 0, 0, 0}});
        else
            influences.push_back({{upper, lower, 0, 0}, {1 - of_shin, of_shin, 0, 0}});
    }
    return influences;
}

/// Angles of one leg, in radians, positive ahead.
struct LegPose {
    double thigh = 0;
    double knee = 0;
};

/// At a share of the stride; the right leg is half a stride behind the left.
LegPose leg_pose(double share) {
    const double angle = 2 * std::numbers::pi * share;
    return {0.471 * std::sin(angle), 0.137 + 0.713 * std::max(0.0, std::cos(angle))};
}

/// How far below the hips' joint a leg reaches: to the lowest point of its foot.
double reach(const LegPose& pose) {
    const double ahead = pose.thigh - pose.knee; // of the shin
    return thigh * std::cos(pose.thigh) + shin * std::cos(ahead) - foot_ahead * std::sin(ahead) +
           std::hypot(foot_radii.y * std::cos(ahead), foot_radii.z * std::sin(ahead));
}

/// What hangs from a joint swings ahead where the joint rotates back about x.
void add_swing(Track& track, double ahead) {
    track.values.insert(track.values.end(), {-std::sin(ahead / 2), 0, 0, std::cos(ahead / 2)});
}

/// Tracks of legs and hips, 16 key frames per stride.
std::vector<Track> walk(const glm::dvec3& from, const glm::dvec3& to) {
    constexpr int keys = 16;
    constexpr double above_floor = 0.037; // the lower foot at key frames
    std::vector<float> times;
    Track height{"hips", "translation", {}, {}};
    Track joints[]{{"left thigh", "rotation", {}, {}},
                   {"left shin", "rotation", {}, {}},
                   {"right thigh", "rotation", {}, {}},
                   {"right shin", "rotation", {}, {}}};
    for (int i = 0; i <= keys; ++i) {
        const double share = static_cast<double>(i) / keys;
        const LegPose left = leg_pose(share);
        const LegPose right = leg_pose(share + 0.5);
        times.push_back(static_cast<float>(stride_seconds * share));
        const double hip = std::max(reach(left), reach(right)) + above_floor;
        height.values.insert(height.values.end(), {0, hip, 0});
        add_swing(joints[0], left.thigh);
        add_swing(joints[1], -left.knee);
        add_swing(joints[2], right.thigh);
        add_swing(joints[3], -right.knee);
    }
    std::vector<Track> tracks{
        {"figure", "translation", {0, stride_seconds}, {from.x, from.y, from.z, to.x, to.y, to.z}},
        height};
    tracks.insert(tracks.end(), std::begin(joints), std::end(joints));
    for (std::size_t i = 1; i < tracks.size(); ++i) tracks[i].times = times;
    return tracks;
}

/// Each arm moves with the opposite leg: the right one is ahead when the left leg is.
std::vector<double> weights_of_poses() {
    return {0, 0, 0, 1, 0, 0, 1, 0, 0, 0}; // of two poses, at quarters of the stride
}

/// Arms and trunk are key-framed by morph targets, legs by a skin; left and right are each other's
/// mirror images and share the same half of the picture.
Stage walking_figure() {
    Stage stage = lit_from_the_left("walking_figure",
                                    "A figure walks within two seconds: legs by a skin, arms and "
                                    "trunk by morph targets; halves wear one picture, mirrored.");
    stage.target = {0.341, 1.471, 0.013};
    stage.yfov = 0.3937;
    stage.textures = {{"mail", png_of(normal_map(48, 48, bumps(3, 3), 5))},
                      {"cloth", png_of(glossy_stripes(48, 48, bumps(3, 3), {0.89, 0.81, 0.63},
                                                      {0.37, 0.47, 0.71}))}};
    constexpr double heading = 0.9371; // radians from the eye's side towards the right
    const glm::dvec3 ahead(std::sin(heading), 0, std::cos(heading));
    constexpr double half_way = 1.313;
    stage.joints = {{"figure", std::nullopt, -half_way * ahead, heading},
                    {"hips", root, {0, hip_height, 0}},
                    {"left thigh", hips, {hip_apart, 0, 0}},
                    {"left shin", left_thigh, {0, -thigh, 0}},
                    {"right thigh", hips, {-hip_apart, 0, 0}},
                    {"right shin", right_thigh, {0, -thigh, 0}}};
    const Look look{
        .bump = 0, .decal = 1, .gloss_in_alpha = true, .specular = glm::dvec3(0.7, 0.7, 0.65)};
    const Shape body = trunk();
    const Shape arm = left_arm();
    const Shape legs =
        joined({left_leg(), left_foot(), mirrored(joined({left_leg(), left_foot()}))});
    constexpr double twist = 0.2713;
    const auto trunk_twist = [](double most) {
        return [=](const glm::dvec3& point) { return twisted(point, twist_at(point.y, most)); };
    };
    add(stage, {{.name = "trunk",
                 .shape = body,
                 .color = {0.95, 0.95, 0.95},
                 .position = {0, 0, 0},
                 .look = look,
                 .morphs = {posed(body, trunk_twist(-twist)), posed(body, trunk_twist(twist))},
                 .joint = hips},
                {.name = "arms",
                 .shape = joined({arm, mirrored(arm)}),
                 .color = {0.95, 0.75, 0.45},
                 .position = {0, 0, 0},
                 .look = look,
                 .morphs = {arms_posed(arm, 0.613, -twist), arms_posed(arm, -0.613, twist)},
                 .joint = hips},
                {.name = "legs",
                 .shape = legs,
                 .color = {0.65, 0.55, 0.75},
                 .look = look,
                 .influences = leg_influences(legs)}});
    stage.tracks = walk(-half_way * ahead, half_way * ahead);
    std::vector<float> quarters;
    for (int i = 0; i <= 4; ++i) quarters.push_back(static_cast<float>(stride_seconds * i / 4));
    for (const char* part : {"trunk", "arms"})
        stage.tracks.push_back({part, "weights", quarters, weights_of_poses()});
    return stage;
}

} // namespace

std::vector<Stage> stages_of_figures() {
    return {walking_figure()};
}

} // namespace shadowproof::author
