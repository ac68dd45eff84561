#include "scenes/load/gltf/gltf.h"

#include "scenes/load/common/default_floor.h"
#include "scenes/load/gltf/check.h"
#include "scenes/load/gltf/mesh.h"
#include "scenes/load/gltf/pose.h"
#include "scenes/load/gltf/view.h"

#include <fmt/format.h>

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace shadowproof {

namespace {

using namespace gltf;

void note_extensions(const Document& document, Scene& scene) {
    for (const std::string& name : document.model.extensionsUsed)
        if (!is_evaluated(name))
            scene.notes.push_back(fmt::format("the extension {} is not evaluated", name));
}

/// Every primitive has its own material; what a variant would give it is not looked at.
void note_variants(const Document& document, Scene& scene) {
    const auto found = document.model.extensions.find("KHR_materials_variants");
    if (found == document.model.extensions.end()) return;
    const std::size_t variants =
        found->second.Has("variants") ? found->second.Get("variants").ArrayLen() : 0;
    scene.notes.push_back(fmt::format(
        "of {} material variants none is chosen: each primitive has its default material",
        variants));
}

/// extras.shadowproof.KEY, an array of cause names, at the root of the file; none where there is
/// no such array.
std::optional<std::vector<Cause>> read_causes(const Document& document, const std::string& key) {
    const nlohmann::json::json_pointer pointer("/shadowproof/" + key);
    // extras may be of any type; only an object with our name in it is read.
    if (!document.extras.is_object() || !document.extras.contains(pointer)) return std::nullopt;
    std::vector<Cause> causes;
    for (const std::string name : document.extras[pointer]) {
        const auto cause = cause_named(name);
        if (!cause)
            (document.root() / "extras" / "shadowproof" / key / causes.size())
                .refuse(fmt::format("\"{}\" is no cause", name),
                        "use a name that `shadowproof list` prints");
        causes.push_back(*cause);
    }
    return causes;
}

/// `provokesWide`: causes that a picture may show in addition where it is wider than high.
/// After choose_camera.
void read_provokes(const Document& document, Scene& scene) {
    const auto provokes = read_causes(document, "provokes");
    scene.declares_provokes = provokes.has_value();
    scene.provokes = provokes.value_or(std::vector<Cause>());
    const auto wide = read_causes(document, "provokesWide");
    if (wide && scene.camera.width > scene.camera.height) scene.may_provoke = *wide;
}

/// Each note once, in the order in which they came.
void drop_repeated(std::vector<std::string>& notes) {
    std::set<std::string> seen;
    std::erase_if(notes, [&](const std::string& note) { return !seen.insert(note).second; });
}

} // namespace

Scene load_gltf(const std::filesystem::path& file, const SceneRequest& request) {
    const Document document = read_document(file, request.memory);
    Scene scene;
    scene.name = file.stem().string();
    scene.file = file;
    note_extensions(document, scene);
    note_variants(document, scene);
    NodeGraph graph = read_nodes(document, scene.notes);
    AccessorReader reader(document);
    pose_nodes(reader, request.time, graph, scene.notes);
    place_nodes(graph);
    bake_meshes(reader, graph, request.normals, scene);
    scene.camera = choose_camera(document, graph, request, scene);
    choose_light(document, graph, request, scene);
    if (request.floor && scene.default_framing) add_default_floor(scene);
    read_provokes(document, scene);
    drop_repeated(scene.notes);
    return scene;
}

} // namespace shadowproof
