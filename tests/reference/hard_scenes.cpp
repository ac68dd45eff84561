#include "tests/reference/hard_scenes.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

namespace shadowproof {

namespace {

constexpr int size = 32;

glm::vec3 random_point(std::mt19937& random, const glm::vec3& centre, float radius) {
    std::uniform_real_distribution<float> spread(-radius, radius);
    const float x = spread(random);
    const float y = spread(random);
    const float z = spread(random);
    return centre + glm::vec3(x, y, z);
}

/// Triangles of all sizes before the camera, double sided.
Scene soup(std::uint32_t seed, float scale, const glm::vec3& offset) {
    std::mt19937 random(seed);
    Scene scene = empty_scene(size);
    std::uniform_real_distribution<float> extent(0.1F, 1.5F);
    for (int i = 0; i < 24; ++i) {
        const glm::vec3 centre = random_point(random, {0, 0, -4}, 2.5F);
        const float radius = extent(random);
        add_triangle(scene, offset + scale * random_point(random, centre, radius),
                     offset + scale * random_point(random, centre, radius),
                     offset + scale * random_point(random, centre, radius));
    }
    scene.lights[0].position = glm::dvec3(offset) + double(scale) * glm::dvec3(1.3, 2.1, -1.2);
    scene.camera.eye = glm::dvec3(offset);
    scene.camera.near = 0.1 * scale;
    finish(scene, true);
    return scene;
}

/// A regular grid of quads that faces the camera, its vertices exactly on pixel rays.
Scene vertices_on_rays() {
    Scene scene = empty_scene(size);
    for (int j = -4; j < 4; ++j)
        for (int i = -4; i < 4; ++i) {
            // Pixel rays are odd multiples of 1 / size at depth 1; at depth 4, of 4 / size.
            const auto at = [](int x, int y) {
                return glm::vec3(float(8 * x + 1) / size * 4, float(8 * y + 1) / size * 4, -4);
            };
            add_triangle(scene, at(i, j), at(i + 1, j), at(i + 1, j + 1));
            add_triangle(scene, at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
    add_box(scene, {-0.5F, -0.5F, -2.5F}, {0.5F, 0.5F, -2});
    scene.lights[0].position = {0.25, 0.25, -1};
    finish(scene, false);
    return scene;
}

/// Boxes on a floor, all axis-parallel, the light where `position` says.
Scene boxes(const glm::dvec3& position, bool double_sided = false) {
    Scene scene = empty_scene(size);
    add_box(scene, {-3, -1.5F, -8}, {3, -1, -2});
    add_box(scene, {-0.5F, -1, -4}, {0.5F, 0, -3});
    add_box(scene, {0.75F, -1, -5}, {1.75F, 1, -4});
    add_box(scene, {-2, -1, -5}, {-1, 0.5F, -4});
    scene.lights[0].position = position;
    finish(scene, double_sided);
    return scene;
}

/// The scene under a directional light; `to_light` need not be normalised.
Scene under_sun(Scene scene, const glm::dvec3& to_light) {
    scene.lights[0].kind = Light::Kind::directional;
    scene.lights[0].direction = -to_light;
    return scene;
}

/// The scene under a spot light where its light was.
Scene under_spot(Scene scene, const glm::dvec3& direction, double outer_cone) {
    scene.lights[0].kind = Light::Kind::spot;
    scene.lights[0].direction = direction;
    scene.lights[0].outer_cone = outer_cone;
    return scene;
}

/// Of floor and three boxes, one box does not cast, one does not receive, and the floor neither.
Scene with_mixed_casters(Scene scene) {
    scene.meshes.clear();
    for (std::uint32_t i = 0; i < 4; ++i)
        scene.meshes.push_back({.name = "box",
                                .first_triangle = 12 * i,
                                .triangle_count = 12,
                                .material = 0,
                                .casts = i != 0 && i != 1,
                                .receives = i != 0 && i != 2});
    return scene;
}

/// Long thin triangles, edges nearly through the pixel rays.
Scene slivers() {
    Scene scene = empty_scene(size);
    for (int i = -8; i < 8; ++i) {
        const float x = float(2 * i + 1) / size * 3;
        add_triangle(scene, {x, -3, -3}, {std::nextafter(x, 9.0F), 3, -3.01F}, {x, 3, -3});
        add_triangle(scene, {-3, x, -3.5F}, {3, std::nextafter(x, 9.0F), -3.5F}, {3, x, -3.4F});
    }
    add_box(scene, {-4, -4, -6}, {4, 4, -5});
    scene.lights[0].position = {0.1, 0.2, -1};
    finish(scene, true);
    return scene;
}

/// The same triangles twice, and a third copy next to them by one unit in the last place.
Scene coinciding() {
    Scene scene = boxes({2, 3, -2});
    const std::vector<glm::uvec3> once = scene.triangles;
    for (const glm::uvec3& t : once) scene.triangles.push_back(t);
    for (const glm::uvec3& t : once) {
        const auto lifted = [&](glm::uint i) {
            glm::vec3 p = scene.positions[i];
            p.z = std::nextafter(p.z, 0.0F);
            return p;
        };
        add_triangle(scene, lifted(t.x), lifted(t.y), lifted(t.z));
    }
    finish(scene, false);
    return scene;
}

/// Needles towards the light and points without extent.
Scene degenerate_triangles() {
    Scene scene = boxes({1, 2.5, -2});
    std::mt19937 random(7);
    for (int i = 0; i < 16; ++i) {
        const glm::vec3 p = random_point(random, {0, 0, -3.5F}, 1);
        const glm::vec3 q = random_point(random, {0, 0, -3.5F}, 1);
        add_triangle(scene, p, q, p);
        add_triangle(scene, p, p, p);
        add_triangle(scene, p, 0.5F * (p + q), q);
    }
    finish(scene, true);
    return scene;
}

/// Vertices as small as floats go, beyond what limbs can hold.
Scene denormals() {
    Scene scene = boxes({2, 3, -2});
    for (glm::vec3& p : scene.positions)
        if (p.y == -1.0F) p.y += 1e-39F;
    add_triangle(scene, {1e-40F, 0, -3}, {1, 1e-42F, -3}, {0, 1, -3});
    scene.positions.back().x = 1e-44F;
    finish(scene, true);
    return scene;
}

} // namespace

Scene empty_scene(int width) {
    Scene scene;
    scene.name = "test";
    scene.camera.width = width;
    scene.camera.height = width;
    scene.camera.near = 0.125;
    scene.lights.emplace_back();
    scene.lights[0].name = "light";
    return scene;
}

void add_triangle(Scene& scene, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const auto first = static_cast<glm::uint>(scene.positions.size());
    scene.positions.insert(scene.positions.end(), {a, b, c});
    scene.triangles.emplace_back(first, first + 1, first + 2);
}

void add_box(Scene& scene, const glm::vec3& lower, const glm::vec3& upper) {
    const auto first = static_cast<glm::uint>(scene.positions.size());
    for (int i = 0; i < 8; ++i)
        scene.positions.emplace_back((i & 1) != 0 ? upper.x : lower.x,
                                     (i & 2) != 0 ? upper.y : lower.y,
                                     (i & 4) != 0 ? upper.z : lower.z);
    constexpr std::array<std::array<glm::uint, 4>, 6> faces{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    for (const auto& f : faces) {
        scene.triangles.emplace_back(first + f[0], first + f[1], first + f[2]);
        scene.triangles.emplace_back(first + f[0], first + f[2], first + f[3]);
    }
}

void finish(Scene& scene, bool double_sided) {
    scene.materials = {{"material", double_sided}};
    scene.meshes = {{"mesh", 0, static_cast<std::uint32_t>(scene.triangles.size()), 0}};
}

namespace {

std::vector<HardScene> sunlit_scenes() {
    std::vector<HardScene> scenes;
    const auto add = [&](const char* name, auto make, const glm::dvec3& to_light) {
        scenes.push_back({name, [make, to_light] { return under_sun(make(), to_light); }});
    };
    const auto boxes_below = [] { return boxes({}); };
    const auto open_boxes_below = [] { return boxes({}, true); };
    add("sun_on_a_soup", [] { return soup(1, 1, {0, 0, 0}); }, {0.3, 0.8, 0.52});
    add("sun_behind_a_soup", [] { return soup(2, 1, {0, 0, 0}); }, {-0.2, 0.1, -0.97});
    add("sun_on_a_soup_scaled_by_1e6", [] { return soup(6, 1e6F, {0, 0, 0}); }, {0.6, -0.8, 0.1});
    add("sun_on_a_soup_1e6_away", [] { return soup(7, 1, {1e6F, -1e6F, 1e6F}); }, {-1, 0.2, 0.3});
    add("sun_on_a_soup_scaled_by_1e-30", [] { return soup(8, 1e-30F, {0, 0, 0}); }, {1, 2, 1});
    add("sun_on_a_soup_scaled_by_1e25", [] { return soup(9, 1e25F, {0, 0, 0}); }, {1, 2, -1});
    add("sun_over_boxes", boxes_below, {0.36, 0.8, 0.48});
    add("sun_below_boxes", boxes_below, {0.36, -0.8, 0.48});
    add("sun_along_edges", boxes_below, {0, 1, 0});
    add("sun_along_edges_of_double_sided_boxes", open_boxes_below, {0, 1, 0});
    add("sun_in_planes_of_faces", boxes_below, {1, 1, 0});
    add("sun_in_planes_of_faces_of_double_sided_boxes", open_boxes_below, {0, 0.5, 0.5});
    add("sun_nearly_along_edges", boxes_below, {0x1p-52, 1, -0x1p-53});
    add("sun_along_edges_but_for_1e-200", boxes_below, {1e-200, 1, 0});
    add("sun_along_the_view", open_boxes_below, {0, 0, 1});
    add("sun_straight_behind_a_pixels_ray", open_boxes_below, {-3.0 / 32, 5.0 / 32, 1});
    add("sun_straight_ahead_of_a_pixels_ray", open_boxes_below, {5.0 / 32, 3.0 / 32, -1});
    // From (1/8, 1/8, -4), a vertex that a pixel sees, past the corner (1/2, 1/2, -2).
    add("sun_through_vertices", vertices_on_rays, {0.375, 0.375, 2});
    add("sun_through_edges", vertices_on_rays, {0.375, 0.1, 2});
    add("sun_on_slivers", slivers, {0.1, 0.2, 1});
    add("sun_on_coinciding_triangles", coinciding, {2, 3, 1});
    add("sun_on_degenerate_triangles", degenerate_triangles, {1, 2.5, 1.5});
    add("sun_on_denormal_vertices", denormals, {2, 3, 1});
    return scenes;
}

} // namespace

namespace {

Scene lit_from(Scene scene, const glm::dvec3& place) {
    scene.lights[0].position = place;
    return scene;
}

/// The camera, from where it is, at a point, its picture so many times as high as it is far.
void zoom(Camera& camera, const glm::dvec3& target, double half_height) {
    camera.forward = glm::normalize(target - camera.eye);
    camera.right = glm::normalize(glm::cross(camera.forward, glm::dvec3(0, 1, 0)));
    camera.up = glm::cross(camera.right, camera.forward);
    camera.half_height = half_height;
}

/// A slanting triangle over a floor; the picture shows little more than the shadow of the middle of
/// an edge, so that a light that is misplaced a little moves the shadow out of it.
Scene shadow_of_an_edge(const glm::dvec3& light, double half_height) {
    const glm::vec3 a(-1, -0.5F, -5);
    const glm::vec3 b(1.5F, 0.75F, -3);
    Scene scene = empty_scene(16);
    add_triangle(scene, a, b, {0, 3, -4});
    add_triangle(scene, {-60, -60, -8}, {60, -60, -8}, {0, 90, -8});
    finish(scene, true);
    scene.lights[0].position = light;
    const glm::dvec3 middle = 0.5 * (glm::dvec3(a) + glm::dvec3(b));
    const glm::dvec3 along = middle - light;
    zoom(scene.camera, light + (-8 - light.z) / along.z * along, half_height);
    return scene;
}

/// Further than far_light (shear.h), with all the bits that doubles have or with few of them.
std::vector<HardScene> far_lit_scenes() {
    std::vector<HardScene> scenes;
    const std::vector<std::pair<std::string, glm::dvec3>> places{
        {"above", {0.5, 0x1p17, -3.5}},
        {"in_front", {0.25, -0.125, -0x1p20}},
        {"behind", {0, 0, 0x1p20}},
        {"askew", {-70123.7, 81234.3, 60321.1}},
        {"at_1e9", {7.1e8, 6.2e8, -3.3e8}},
        {"at_1e15", {-3e14, 1e15, 2e14}},
        {"just_far", {11234.1, 45678.2, 22345.3}},
        {"not_quite_far", {1123.1, 4567.2, 2234.3}},
    };
    for (const auto& [name, place] : places) {
        const auto add = [&](const std::string& what, const std::function<Scene()>& make) {
            scenes.push_back({what + "_lit_from_far_" + name,
                              [make, at = place] { return lit_from(make(), at); }});
        };
        add("boxes", [] { return boxes({}, true); });
        add("soup", [] { return soup(21, 1, {0, 0, 0}); });
        add("slivers", slivers);
        add("coinciding_triangles", coinciding);
    }
    for (const auto& [name, light] :
         std::vector<std::pair<std::string, glm::dvec3>>{{"6e5", {2e5, 1.3e5, 5.3e5}},
                                                         {"askew", {-7e5, 1.1e6, 4e5}},
                                                         {"level", {3e6, -4e5, 1e6}},
                                                         {"1e9", {3e8, 2e8, 7e8}},
                                                         {"1e15", {-2e14, 1e14, 9e14}}})
        for (const auto& [extent, tan] : std::vector<std::pair<std::string, double>>{
                 {"wide", 1e-2}, {"near", 1e-4}, {"close", 1e-6}})
            scenes.push_back({"edge_lit_from_" + name + "_" + extent,
                              [light, tan] { return shadow_of_an_edge(light, tan); }});
    // Rays that run down from the light among the casters are those of a picture this small.
    for (const double tan : {0x1p-18, 0x1p-20})
        scenes.push_back({"along_far_light_" + std::to_string(static_cast<int>(1 / tan)), [tan] {
                              Scene scene = lit_from(boxes({}, true), {0.5, -0.25, 0x1p20});
                              scene.camera.half_height = tan;
                              return scene;
                          }});
    // Its light is far from all but one triangle, which stands between both, or behind it.
    for (const float distance : {3e5F, 3e6F})
        scenes.push_back(
            {"far_light_and_a_triangle_at_" + std::to_string(static_cast<int>(distance)),
             [distance] {
                 Scene scene = boxes({}, true);
                 scene.meshes.clear();
                 add_triangle(scene, {-distance, distance, -distance},
                              {distance, distance, -distance}, {0, distance, distance});
                 finish(scene, true);
                 return lit_from(scene, {1e3, 1e6, -2e3});
             }});
    return scenes;
}

} // namespace

std::vector<HardScene> hard_scenes() {
    std::vector<HardScene> scenes;
    for (std::uint32_t seed = 1; seed <= 4; ++seed)
        scenes.push_back({"soup_" + std::to_string(seed), [seed] {
                              return soup(seed, 1, {0, 0, 0});
                          }});
    scenes.push_back({"soup_scaled_by_1e-4", [] { return soup(5, 1e-4F, {0, 0, 0}); }});
    scenes.push_back({"soup_scaled_by_1e6", [] { return soup(6, 1e6F, {0, 0, 0}); }});
    scenes.push_back({"soup_1e6_away", [] { return soup(7, 1, {1e6F, -1e6F, 1e6F}); }});
    scenes.push_back({"soup_scaled_by_1e-30", [] { return soup(8, 1e-30F, {0, 0, 0}); }});
    scenes.push_back({"soup_scaled_by_1e25", [] { return soup(9, 1e25F, {0, 0, 0}); }});
    scenes.push_back({"far_plane_whose_inverse_is_no_float", [] {
                          Scene scene = soup(5, 1e-7F, {0, 0, 0});
                          scene.camera.far = 3e38;
                          return scene;
                      }});
    scenes.push_back({"rays_through_vertices_and_edges", vertices_on_rays});
    scenes.push_back({"ordinary_light", [] { return boxes({2.1, 3.3, -1.7}); }});
    scenes.push_back({"light_in_plane_of_a_face", [] { return boxes({3.5, 0, -1}); }});
    scenes.push_back({"light_in_planes_of_two_faces", [] { return boxes({0.5, 0, -1}); }});
    scenes.push_back({"light_on_an_edge", [] { return boxes({0.5, 0, -3.5}, true); }});
    scenes.push_back({"light_on_a_vertex", [] { return boxes({0.5, 0, -3}, true); }});
    scenes.push_back({"light_on_a_face", [] { return boxes({0.25, 0, -3.5}, true); }});
    scenes.push_back({"light_at_the_eye", [] { return boxes({0, 0, 0}); }});
    scenes.push_back({"light_inside_a_box", [] { return boxes({0, -0.5, -3.5}, true); }});
    scenes.push_back({"slivers", slivers});
    scenes.push_back({"coinciding_triangles", coinciding});
    scenes.push_back({"degenerate_triangles", degenerate_triangles});
    scenes.push_back({"denormal_vertices", denormals});
    scenes.push_back({"near_and_far_in_planes", [] {
                          Scene scene = boxes({2, 3, -2});
                          scene.camera.near = 3;
                          scene.camera.far = 5;
                          return scene;
                      }});
    scenes.push_back({"camera_axes_of_1e-200", [] {
                          Scene scene = boxes({0.5, 0, -1});
                          scene.camera.forward.x = 1e-200;
                          scene.camera.up.z = -1e-200;
                          return scene;
                      }});
    for (HardScene& scene : sunlit_scenes()) scenes.push_back(std::move(scene));
    for (HardScene& scene : far_lit_scenes()) scenes.push_back(std::move(scene));
    scenes.push_back({"casters_and_receivers_of_all_kinds", [] {
                          return with_mixed_casters(boxes({2.1, 3.3, -1.7}));
                      }});
    scenes.push_back({"double_sided_casters_and_receivers_under_a_sun", [] {
                          return with_mixed_casters(under_sun(boxes({}, true), {0.7, 1, 0.4}));
                      }});
    scenes.push_back({"spot_on_boxes", [] {
                          return under_spot(boxes({0.25, 3, -3}), {0, -1, 0}, 0.4);
                      }});
    scenes.push_back({"spot_on_a_soup", [] {
                          return under_spot(soup(13, 1, {0, 0, 0}), {-0.6, -0.64, -0.48}, 0.6);
                      }});
    scenes.push_back({"spot_of_half_a_space_far_away", [] {
                          return under_spot(soup(14, 1, {1e6F, -1e6F, 1e6F}), {-0.8, 0, 0.6},
                                            1.5707963267948966);
                      }});
    return scenes;
}

std::vector<HardScene> orthographic_scenes() {
    std::vector<HardScene> scenes;
    for (HardScene& hard : hard_scenes()) {
        const bool sees_all = scenes.size() % 2 == 1;
        scenes.push_back({std::move(hard.name), [make = std::move(hard.make), sees_all] {
                              Scene scene = make();
                              Camera& camera = scene.camera;
                              // As high as the perspective picture is at a depth of 4 where the
                              // scene's unit is 1: then vertices lie on lines of sight there, too.
                              const bool is_between_planes = camera.far == 5;
                              const double unit = is_between_planes ? 1 : 8 * camera.near;
                              camera.projection = Projection::orthographic;
                              camera.half_height = 4 * unit * camera.half_height;
                              if (sees_all) camera.near = 0;
                              return scene;
                          }});
    }
    return scenes;
}

} // namespace shadowproof
