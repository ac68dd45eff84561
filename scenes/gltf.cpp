#include "scenes/gltf.h"

#include "scenes/error.h"
#include "scenes/gltf_mesh.h"
#include "scenes/gltf_pose.h"
#include "scenes/gltf_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

namespace shadowproof {

namespace {

using namespace gltf;

/// Evaluated in full, or of no weight for what is seen and what casts.
bool is_evaluated(std::string_view extension) {
    constexpr std::array<std::string_view, 2> evaluated{"KHR_lights_punctual",
                                                        "KHR_mesh_quantization"};
    return std::find(evaluated.begin(), evaluated.end(), extension) != evaluated.end();
}

/// Changes the look of a surface only, and visibility alone is judged.
bool is_only_look(std::string_view extension) {
    return extension.starts_with("KHR_materials_") || extension.starts_with("KHR_texture_") ||
           extension == "EXT_texture_webp" || extension == "KHR_xmp_json_ld";
}

/// Refuses what the file requires and is not evaluated; says what it merely uses.
void check_extensions(const Document& document, Scene& scene) {
    if (const auto required = document.root().find("extensionsRequired"))
        for (std::size_t i = 0; i < required->size(); ++i) {
            const Item item = (*required)[i];
            const std::string name = item.text();
            if (!is_evaluated(name) && !is_only_look(name))
                item.refuse(fmt::format("requires the extension {}, which is not evaluated", name),
                            "export the asset without it");
        }
    if (const auto used = document.root().find("extensionsUsed"))
        for (std::size_t i = 0; i < used->size(); ++i)
            if (const std::string name = (*used)[i].text(); !is_evaluated(name))
                scene.notes.push_back(fmt::format("the extension {} is not evaluated", name));
}

/// extras.shadowproof.provokes, an array of cause names, at the root of the file.
void read_provokes(const Document& document, Scene& scene) {
    const auto extras = document.root().find("extras");
    // extras may be anything at all; only an object with our name in it speaks to us.
    if (!extras || !document.json["extras"].is_object()) return;
    const auto own = extras->find("shadowproof");
    const auto provokes = own ? own->find("provokes") : std::nullopt;
    if (!provokes) return;
    scene.declares_provokes = true;
    for (std::size_t i = 0; i < provokes->size(); ++i) {
        const Item item = (*provokes)[i];
        const auto cause = cause_named(item.text());
        if (!cause)
            item.refuse(fmt::format("\"{}\" is no cause", item.text()),
                        "use a name that `shadowproof list` prints");
        scene.provokes.push_back(*cause);
    }
}

/// Each note once, in the order in which they came.
void drop_repeated(std::vector<std::string>& notes) {
    std::set<std::string> seen;
    std::erase_if(notes, [&](const std::string& note) { return !seen.insert(note).second; });
}

} // namespace

Scene load_gltf(const std::filesystem::path& file, const SceneRequest& request) {
    const Document document = read_document(file);
    Scene scene;
    scene.name = file.stem().string();
    scene.file = file;
    check_extensions(document, scene);
    read_provokes(document, scene);
    NodeGraph graph = read_nodes(document);
    AccessorReader reader(document);
    pose_nodes(reader, request.time, graph, scene.notes);
    place_nodes(document, graph);
    bake_meshes(reader, graph, scene);
    scene.camera = choose_camera(document, graph, request, scene);
    choose_light(document, graph, request, scene);
    drop_repeated(scene.notes);
    return scene;
}

} // namespace shadowproof
