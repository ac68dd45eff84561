#include "scenes/load/catalog.h"

#include "scenes/error.h"
#include "scenes/load/admission.h"
#include "scenes/load/common/nearest_name.h"
#include "scenes/load/common/override_view.h"
#include "scenes/load/gltf/gltf.h"
#include "scenes/load/md2/md2.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <system_error>

#ifndef SHADOWPROOF_SOURCE_SCENES
#error "SHADOWPROOF_SOURCE_SCENES and SHADOWPROOF_INSTALLED_SCENES are set by CMakeLists.txt"
#endif

namespace shadowproof {

const std::vector<BundledScene>& bundled_scenes() {
    static const std::vector<BundledScene> scenes{
        {"ordinary", "box, torus and ball on a floor: nothing that any technique fails at"},
        {"near_plane", "a volume passes between the eye and a part of the near plane"},
        {"far_plane", "volumes run through the far plane behind lit surfaces"},
        {"eye_inside", "the eye stands in the shadow of a canopy"},
        {"near_cap_all", "all of a small ring is projected onto the near plane"},
        {"near_cap_some", "one end of a rod through the near plane is projected onto it"},
        {"near_cap_none", "a ring behind the near plane, nothing of it projected there"},
        {"eye_on_side", "the eye lies exactly on a side of a shadow volume"},
        {"seen_shadow", "the eye stands in a shadow that it sees fall on the floor"},
        {"far_cut", "the far plane cuts the casters themselves"},
        {"light_inside", "the light is inside a closed ball, and darkness around it"},
        {"light_in_plane", "the light lies exactly in the planes of several faces"},
        {"light_on_face", "the light lies on a face of a board, as near as floats tell"},
        {"light_on_edge",
         "the light lies on an edge of a board, and the eye behind it in the dark"},
        {"long_shadow", "shadows longer than the scene's radius, under a low light"},
        {"sun", "a directional light: all its rays run one way"},
        {"spot", "a spot light, whose cone ends on the floor"},
        {"moving_light", "an animated light over a sundial, chosen by --time"},
        {"many_lights", "three lights over a sundial, chosen by --light"},
        {"nested", "300 nested gems: the shadow is 256 deep where an 8-bit counter reads 0"},
        {"overlapping", "the shadows of three coins overlap by twos and threes"},
        {"idle_casters", "most casters shadow nothing that is seen: what auto leaves out"},
        {"open_lid", "light falls into a box without a lid"},
        {"inverted", "a box wound inside out"},
        {"non_manifold", "two boxes share an edge of four triangles"},
        {"t_junctions", "a closed box whose faces meet corner against edge"},
        {"bumpy_sphere", "a normal map, lit; tangents by MikkTSpace's rule"},
        {"bumpy_torus", "a normal map, a decal and its gloss, on tangents of the asset's own"},
        {"mirrored_skin", "both halves of a head wear one normal map, mirrored"},
        {"height_field", "bumps by a height field instead of a normal map"},
        {"stretched_relief", "heights in the file's units, stretched four to one"},
        {"skewed_relief", "heights in the file's units, on texels that are parallelograms"},
        {"hammered_silver", "a hammered ball and ring that reflect an environment"},
        {"coarse_curve", "a bumpy capsule of few triangles, half in a spot light"},
        {"grazing_light", "the sun grazes a bumpy ground: self-shadowing terms between 0 and 1"},
        {"terminator_highlight", "highlights where the light hardly reaches, near the terminator"},
        {"fine_relief", "a height field as fine as pixels; the light fades with distance"},
        {"bright_light", "ambient and diffuse light add up to more than 1 before the decal"},
        {"bumpy_near_plane", "near_plane with bumps, whose light its shadows spoil"},
        {"bumpy_far_plane", "far_plane with bumps, whose light its shadows spoil"},
        {"bumpy_eye_inside", "eye_inside with bumps, whose light its shadows spoil"},
        {"bumpy_lights", "bumps under two lights, which are added up"},
        {"distant_bumps", "bumps of which up to a hundred texels lie in a pixel"},
        {"walking_figure", "a figure in motion by morph targets and a skin, chosen by --time"},
        {"thin_caster", "shadows that begin closer to their casters than a map's bias"},
        {"cube_edge", "shadows that run over the edges of a cube around the light"},
        {"far_light", "casters smaller than a texel of the light's map"},
        {"low_light", "a light that grazes the floor, where a map's texels are steep"},
        {"light_range", "a light whose range, where a map's far plane lies, ends amid the floor"},
        {"near_light", "wires closer to the light than a map's near plane"},
        {"in_metres", "small things in metres: an epsilon of 1e-3 is a millimetre"},
        {"in_millimetres", "a room in millimetres: floats are further apart than 1e-3"},
        {"slivers", "slivers so thin that float rays slip through between them"},
        {"perforated", "sheets whose alpha masks leave holes, which volumes shadow"},
    };
    return scenes;
}

bool is_bundled(std::string_view name) {
    const auto& all = bundled_scenes();
    return std::any_of(all.begin(), all.end(),
                       [&](const BundledScene& scene) { return scene.name == name; });
}

namespace {

/// <prefix>/bin/shadowproof -> <prefix>/<SHADOWPROOF_INSTALLED_SCENES>.
std::filesystem::path installed_folder() {
    std::error_code failure;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", failure);
    return failure ? std::filesystem::path{}
                   : program.parent_path().parent_path() / SHADOWPROOF_INSTALLED_SCENES;
}

bool holds_scenes(const std::filesystem::path& folder) {
    std::error_code failure;
    return !folder.empty() && std::filesystem::exists(folder / "ordinary.gltf", failure);
}

std::vector<std::string> bundled_names() {
    std::vector<std::string> names;
    for (const BundledScene& scene : bundled_scenes()) names.emplace_back(scene.name);
    return names;
}

std::string listed_names() {
    std::string names;
    for (const BundledScene& scene : bundled_scenes())
        names += fmt::format("{}{}", names.empty() ? "" : ", ", scene.name);
    return names;
}

/// By its extension, in either case; its own reader looks at what is in it.
bool is_md2(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return extension == ".md2";
}

} // namespace

std::filesystem::path bundled_folder() {
    if (const char* given = std::getenv("SHADOWPROOF_SCENES"); given != nullptr && *given != '\0') {
        if (!holds_scenes(given))
            throw Error(fmt::format("SHADOWPROOF_SCENES={}", given), "holds no bundled scenes",
                        "name the folder with ordinary.gltf, or unset it");
        return given;
    }
    for (const std::filesystem::path& folder :
         {installed_folder(), std::filesystem::path(SHADOWPROOF_SOURCE_SCENES)})
        if (holds_scenes(folder)) return folder;
    throw Error("bundled scenes",
                fmt::format("not found beside the program nor in {}", SHADOWPROOF_SOURCE_SCENES),
                "set SHADOWPROOF_SCENES to their folder");
}

namespace {

Scene read_scene(const std::string& name_or_path, const SceneRequest& request) {
    if (is_bundled(name_or_path))
        return load_gltf(bundled_folder() / (name_or_path + ".gltf"), request);
    std::error_code failure;
    if (!std::filesystem::exists(name_or_path, failure))
        throw Error(name_or_path,
                    failure ? fmt::format("cannot be reached ({})", failure.message())
                            : "is neither a bundled scene nor a file" +
                                  did_you_mean(name_or_path, bundled_names()),
                    "use a path to .gltf, .glb or .md2, or one of " + listed_names());
    return is_md2(name_or_path) ? load_md2(name_or_path, request)
                                : load_gltf(name_or_path, request);
}

} // namespace

Scene load_scene(const std::string& name_or_path, const SceneRequest& request) {
    Scene scene = read_scene(name_or_path, request);
    override_view(request.view, scene);
    admit(scene);
    if (!request.stress) return scene;
    scene.normals.clear(); // of other triangles than the stressed ones
    scene = stressed(std::move(scene), *request.stress);
    admit(scene);
    return scene;
}

} // namespace shadowproof
