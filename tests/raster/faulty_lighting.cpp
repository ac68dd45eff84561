#include "tests/raster/faulty_lighting.h"

#include "raster/gl/shader.h"
#include "raster/render.h"
#include "raster/volumes/stencil.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace shadowproof::tests {

namespace {

void flip_hands(Scene& scene) {
    for (Surface& surface : scene.surfaces) surface.tangent.w = -surface.tangent.w;
}

template <class Change>
void change_normal_maps(Scene& scene, const Change& change) {
    std::vector<std::uint32_t> changed;
    for (const Material& material : scene.materials) {
        const bool done =
            std::find(changed.begin(), changed.end(), material.bump_map) != changed.end();
        if (material.bump != Bump::normal_map || done) continue;
        for (glm::vec4& texel : scene.textures[material.bump_map].texels.pixels) change(texel);
        changed.push_back(material.bump_map);
    }
}

void invert_green(Scene& scene) {
    change_normal_maps(scene, [](glm::vec4& texel) { texel.g = 1 - texel.g; });
}

/// As if the map held colours for a screen.
void decode_srgb(Scene& scene) {
    change_normal_maps(scene, [](glm::vec4& texel) {
        for (int c = 0; c < 3; ++c)
            texel[c] = texel[c] <= 0.04045F ? texel[c] / 12.92F
                                            : std::pow((texel[c] + 0.055F) / 1.055F, 2.4F);
    });
}

constexpr LightingFault faults[]{
    {.name = "flipped_hand", .scene = "mirrored_skin", .in_scene = flip_hands},
    {.name = "inverted_green", .scene = "bumpy_torus", .in_scene = invert_green},
    {.name = "wrong_color_space", .scene = "bumpy_sphere", .in_scene = decode_srgb},
    {.name = "exponent_9",
     .scene = "bumpy_sphere",
     .right = "return power;",
     .wrong = "return power * cosine;"},
    {.name = "no_self_shadow",
     .scene = "grazing_light",
     .right = "return clamp(8 * cosine, 0, 1);",
     .wrong = "return 1;"},
    {.name = "normal_map_not_of_unit_length",
     .scene = "bumpy_torus",
     .right = "return dot(normal, normal) > 0 ? unit(normal) : vec3(0, 0, 1);",
     .wrong = "return normal;"},
    {.name = "interpolated_normal_not_of_unit_length",
     .scene = "coarse_curve",
     .right = "vec3 normal = unit(surface.normal);",
     .wrong = "vec3 normal = surface.normal;"},
    {.name = "no_gloss",
     .scene = "bumpy_torus",
     .right = "gloss_in_alpha ? decal.a : 1",
     .wrong = "1"},
    // As the slides on bump mapping in hardware print it, with u and v exchanged.
    {.name = "printed_formula",
     .scene = "height_field",
     .technique = "bump_eye_space",
     .right = "h_u * cross(normal, p_v) + h_v * cross(p_u, normal)",
     .wrong = "h_u * cross(normal, p_u) + h_v * cross(p_v, normal)"},
    {.name = "reflection_turned_round",
     .scene = "hammered_silver",
     .technique = "bump_reflective",
     .right = "2 * dot(normal, v) * normal - v",
     .wrong = "v - 2 * dot(normal, v) * normal"},
    {.name = "reflection_in_tangent_space",
     .scene = "hammered_silver",
     .technique = "bump_reflective",
     .right = "vec3 r = mirrored_at(perturbed_normal(frame()), unit(-surface.from_eye));",
     .wrong = "mat3 frame = frame();\n"
              "vec3 r = mirrored_at(perturbed_normal(frame), unit(-surface.from_eye)) * frame;"},
    {.name = "reflection_on_the_wrong_face",
     .scene = "hammered_silver",
     .technique = "bump_reflective",
     .right = "v.z < 0 ? 5 : 4",
     .wrong = "v.z < 0 ? 4 : 5"},
    {.name = "reflection_without_gloss",
     .scene = "hammered_silver",
     .technique = "bump_reflective",
     .right = "reflectance * decal().a",
     .wrong = "reflectance"},
    {.name = "flipped_hand_in_three_passes",
     .scene = "mirrored_skin",
     .technique = "bump_three_pass",
     .in_scene = flip_hands},
    {.name = "inverted_green_in_one_pass",
     .scene = "bumpy_torus",
     .technique = "bump_one_pass",
     .in_scene = invert_green},
    {.name = "wrong_color_space_in_one_pass",
     .scene = "bumpy_sphere",
     .technique = "bump_one_pass",
     .in_scene = decode_srgb},
};

} // namespace

std::ostream& operator<<(std::ostream& out, const LightingFault& fault) {
    return out << fault.name;
}

std::span<const LightingFault> lighting_faults() {
    return faults;
}

Frame draw_faulty(Gpu& gpu, const Scene& scene, const Plan& plan, const LightingFault& fault) {
    Scene drawn = scene;
    if (fault.in_scene != nullptr) fault.in_scene(drawn);
    if (fault.right == nullptr)
        return draw_with(gpu, *find_technique(fault.technique), drawn, plan);
    const bool eye = fault.technique == std::string("bump_eye_space");
    const bool reflects = fault.technique == std::string("bump_reflective");
    const std::string file =
        reflects ? "bump_reflection.frag" : fault.technique + std::string(".frag");
    std::string text(glsl_source(file));
    const std::size_t at = text.find(fault.right);
    if (at == std::string::npos)
        throw std::logic_error(file + " no longer says " + std::string(fault.right));
    text.replace(at, std::string(fault.right).size(), fault.wrong);
    StencilRecipe recipe = zfail_reversed_recipe(drawn, plan);
    recipe.lighting = {.steps = add_lit_to_ambient({file, text}),
                       .model = {.axes = eye ? ColorModel::Axes::eye : ColorModel::Axes::world,
                                 .reflects = reflects}};
    if (reflects) {
        recipe.lighting->steps = add_lit_to_ambient(shader_file("bump_tangent_space.frag"));
        recipe.lighting->steps.push_back(add_reflection({file, text}));
    }
    return draw_stencil_shadows(gpu, drawn, recipe);
}

} // namespace shadowproof::tests
