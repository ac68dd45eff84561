#include "tests/raster/masked_scene.h"

#include "tests/dice.h"
#include "tests/raster/small_scenes.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof::tests {

namespace {

/// Coordinates of new positions: an affine map of the place, so that both triangles of a rectangle
/// share it.
void set_coordinates(Scene& scene, Dice& dice) {
    const double size = std::exp2(dice.between(-2, 2));
    const double turn = dice.between(0, 6.28);
    const glm::dvec3 along(size * std::cos(turn), size * std::sin(turn), dice.between(-1, 1));
    const glm::dvec3 down(-size * std::sin(turn), size * std::cos(turn), dice.between(-1, 1));
    const glm::dvec2 from(dice.between(-3, 3), dice.between(-3, 3));
    for (std::size_t i = scene.mask_at.size(); i < scene.positions.size(); ++i) {
        const glm::dvec3 at(scene.positions[i]);
        scene.mask_at.emplace_back(from + glm::dvec2(glm::dot(along, at), glm::dot(down, at)));
    }
}

/// The last mesh gets a material of its own.
void give_mask(Scene& scene, Dice& dice) {
    scene.meshes.back().material = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.push_back({.name = "masked",
                               .double_sided = dice.one_in(2),
                               .mask = static_cast<std::uint32_t>(scene.masks.size())});
    scene.masks.push_back(diced_mask(dice.bits()));
}

void add_sheet(Scene& scene, Dice& dice) {
    const glm::dvec3 centre(dice.between(-2, 2), dice.between(0.5, 3), dice.between(-2, 2));
    const glm::dvec3 side(dice.between(0.5, 1.5), dice.between(-1, 1), dice.between(-1, 1));
    const glm::dvec3 up(dice.between(-1, 1), dice.between(-1, 1), dice.between(0.5, 1.5));
    add_rectangle(scene, centre - side - up, centre + side - up, centre + side + up,
                  centre - side + up);
    give_mask(scene, dice);
}

void add_masked_box(Scene& scene, Dice& dice) {
    const glm::dvec3 low(dice.between(-2, 1), dice.between(0.2, 2), dice.between(-2, 1));
    add_box(scene, low,
            low + glm::dvec3(dice.between(0.1, 1), dice.between(0.1, 1), dice.between(0.1, 1)));
    give_mask(scene, dice);
}

} // namespace

AlphaMask diced_mask(std::uint64_t seed) {
    Dice dice(seed);
    constexpr std::array wraps{Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge};
    const auto side = [&] { return static_cast<int>(1 + dice.below(9)); };
    AlphaMask mask{.name = "mask",
                   .alpha = Image<float>(side(), side()),
                   .wrap_s = wraps[dice.below(3)],
                   .wrap_t = wraps[dice.below(3)],
                   .nearest = dice.one_in(4),
                   .least = dice.one_in(2) ? 0.5 : dice.between(0.1, 0.9)};
    const bool halves = dice.one_in(2);
    for (float& alpha : mask.alpha.pixels)
        alpha = static_cast<float>(halves ? 255 * dice.below(2) : dice.below(256)) / 255;
    return mask;
}

Scene masked_scene(std::uint64_t seed) {
    Dice dice(seed);
    Scene scene = box_over_floor();
    scene.name = "masked by dice";
    scene.camera.width = scene.camera.height = 96;
    set_coordinates(scene, dice);
    if (dice.one_in(2)) give_mask(scene, dice); // the box over the floor
    for (std::size_t i = 0, sheets = 1 + dice.below(3); i < sheets; ++i) {
        add_sheet(scene, dice);
        set_coordinates(scene, dice);
    }
    for (std::size_t i = 0, boxes = dice.below(3); i < boxes; ++i) {
        add_masked_box(scene, dice);
        set_coordinates(scene, dice);
    }
    look_at(scene.camera, {dice.between(2, 5), dice.between(3, 7), dice.between(4, 8)},
            {0, 0.7, 0});
    Light& light = scene.lights.front();
    light.position = {dice.between(-3, 3), dice.between(4, 7), dice.between(-3, 3)};
    constexpr std::array kinds{Light::Kind::point, Light::Kind::spot, Light::Kind::directional};
    light.kind = kinds[seed % kinds.size()];
    light.direction = glm::normalize(glm::dvec3(0, 0.5, 0) - light.position);
    light.outer_cone = dice.between(0.4, 1);
    return scene;
}

} // namespace shadowproof::tests
