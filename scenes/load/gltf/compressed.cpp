#include "scenes/load/gltf/compressed.h"

#include "scenes/load/compressed/draco.h"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <string_view>
#include <utility>

namespace shadowproof::gltf {

namespace {

using nlohmann::json;

constexpr const char* draco = "KHR_draco_mesh_compression";

/// The extension's object in an element of the JSON, and its name; nothing where it has none.
struct Extension {
    const json* value = nullptr;
    const char* name = "";
};

Extension meshopt_in(const json& element) {
    const auto extensions = element.find("extensions");
    if (extensions == element.end()) return {};
    for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
        if (const auto found = extensions->find(name); found != extensions->end())
            return {&*found, name};
    return {};
}

MeshoptMode mode_named(const Place& place, const std::string& name) {
    if (name == "ATTRIBUTES") return MeshoptMode::attributes;
    if (name == "TRIANGLES") return MeshoptMode::triangles;
    if (name == "INDICES") return MeshoptMode::indices;
    (place / "mode")
        .refuse(fmt::format("\"{}\" is no mode", name),
                "use \"ATTRIBUTES\", \"TRIANGLES\" or \"INDICES\"");
}

MeshoptFilter filter_named(const Place& place, const std::string& name) {
    if (name == "NONE") return MeshoptFilter::none;
    if (name == "OCTAHEDRAL") return MeshoptFilter::octahedral;
    if (name == "QUATERNION") return MeshoptFilter::quaternion;
    if (name == "EXPONENTIAL") return MeshoptFilter::exponential;
    if (name == "COLOR") return MeshoptFilter::color;
    (place / "filter")
        .refuse(fmt::format("\"{}\" is no filter", name),
                "use \"NONE\", \"OCTAHEDRAL\", \"QUATERNION\", \"EXPONENTIAL\" or \"COLOR\"");
}

/// A new buffer without bytes; its index.
std::size_t add_placeholder(json& document, Compressed& compressed) {
    document["buffers"].push_back({{"byteLength", 1}});
    compressed.placeholders.push_back(true);
    return compressed.placeholders.size() - 1;
}

bool is_fallback(const json& buffer) {
    const Extension extension = meshopt_in(buffer);
    return extension.value != nullptr && extension.value->value("fallback", false);
}

void take_view(const Place& root, std::size_t index, json& document, Compressed& compressed) {
    json& view = document["bufferViews"][index];
    const Extension extension = meshopt_in(view);
    const json& source = *extension.value;
    const Place place = root / "bufferViews" / index / "extensions" / extension.name;
    CompressedView taken{place,
                         {},
                         source["buffer"],
                         source.value("byteOffset", std::size_t{0}),
                         source["byteLength"]};
    taken.layout = {mode_named(place, source["mode"]),
                    filter_named(place, source.value("filter", "NONE")), source["count"],
                    source["byteStride"]};
    check_meshopt(place, taken.layout);
    const std::size_t size = taken.layout.count * taken.layout.stride; // below 2^32 * 2^8
    if (size != view["byteLength"])
        (root / "bufferViews" / index / "byteLength")
            .refuse(fmt::format("is {}, but {} elements of {} bytes are compressed",
                                view["byteLength"].dump(), taken.layout.count, taken.layout.stride),
                    "make it count times byteStride");
    taken.target = add_placeholder(document, compressed);
    view["buffer"] = taken.target;
    view.erase("byteOffset");
    view.erase("extensions");
    compressed.views.push_back(std::move(taken));
}

/// One flag per buffer of the file: nothing is read of it. Those that say so, and those of
/// compressed views that have no bytes.
void find_fallbacks(const json& document, bool has_chunk, Compressed& compressed) {
    const json& buffers = document["buffers"];
    for (std::size_t i = 0; i < buffers.size(); ++i)
        compressed.placeholders[i] = is_fallback(buffers[i]);
    for (const json& view : document["bufferViews"]) {
        const std::size_t buffer = view["buffer"];
        const bool is_empty = !buffers[buffer].contains("uri") && (buffer > 0 || !has_chunk);
        if (is_empty && meshopt_in(view).value != nullptr) compressed.placeholders[buffer] = true;
    }
}

void take_views(const Place& root, json& document, bool has_chunk, Compressed& compressed) {
    if (!document.contains("bufferViews") || !document.contains("buffers")) return;
    find_fallbacks(document, has_chunk, compressed);
    const std::vector<bool> fallbacks = compressed.placeholders;
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < document["bufferViews"].size(); ++i) {
        json& view = document["bufferViews"][i];
        const Place place = root / "bufferViews" / i;
        const Extension extension = meshopt_in(view);
        const json& source = extension.value == nullptr ? view : *extension.value;
        if (fallbacks[source["buffer"].get<std::size_t>()])
            place.refuse("reads a fallback buffer, which holds nothing",
                         "compress the buffer view, or name another buffer");
        if (extension.value == nullptr) continue;
        total += view["byteLength"].get<std::uint64_t>();
        if (total > limits.bytes)
            place.refuse(fmt::format("brings what is compressed above {} bytes", limits.bytes),
                         "split the asset");
        take_view(root, i, document, compressed);
    }
    for (std::size_t i = 0; i < fallbacks.size(); ++i)
        if (fallbacks[i]) document["buffers"][i] = {{"byteLength", 1}};
}

/// Where an accessor's elements are: a buffer view that is a Draco stream, and an id in it.
using DracoSource = std::pair<std::size_t, std::int64_t>;

/// The Draco streams of a document as they are found.
struct DracoFinds {
    const Place& root;
    json& document;
    Compressed& compressed;
    std::map<std::size_t, std::size_t> mesh_of_view{};
    std::map<std::size_t, DracoSource> sources{}; ///< by accessor
};

void take_accessor(DracoFinds& finds, const Place& place, std::size_t mesh, std::size_t accessor,
                   std::int64_t id) {
    CompressedMesh& taken = finds.compressed.meshes[mesh];
    const auto [known, is_new] = finds.sources.emplace(accessor, DracoSource{taken.view, id});
    if (!is_new && known->second != DracoSource{taken.view, id})
        place.refuse(
            fmt::format("names accessor {}, which is decompressed from elsewhere, too", accessor),
            "give each compressed mesh accessors of its own");
    if (!is_new) return;
    const std::size_t buffer = add_placeholder(finds.document, finds.compressed);
    json& views = finds.document["bufferViews"];
    views.push_back({{"buffer", buffer}, {"byteLength", 1}});
    json& source = finds.document["accessors"][accessor];
    source["bufferView"] = views.size() - 1;
    source.erase("byteOffset");
    taken.accessors.push_back({accessor, id, buffer});
}

void take_primitive(DracoFinds& finds, const Place& place, json& primitive) {
    const json source = primitive["extensions"][draco];
    primitive.erase("extensions");
    const Place own = place / "extensions" / draco;
    if (primitive.value("mode", 4) != 4)
        (place / "mode")
            .refuse("is not 4, and the primitive is compressed by Draco",
                    "compress a list of triangles");
    if (!primitive.contains("indices"))
        place.refuse("is compressed by Draco and has no indices",
                     "add an accessor for its indices");
    const std::size_t view = source["bufferView"];
    const auto [mesh, is_new] = finds.mesh_of_view.emplace(view, finds.compressed.meshes.size());
    if (is_new) finds.compressed.meshes.push_back({own, view});
    take_accessor(finds, place / "indices", mesh->second, primitive["indices"], DracoPart::indices);
    for (const auto& [name, id] : source["attributes"].items())
        if (primitive["attributes"].contains(name))
            take_accessor(finds, place / "attributes" / name, mesh->second,
                          primitive["attributes"][name], id);
}

void take_primitives(const Place& root, json& document, Compressed& compressed) {
    if (!document.contains("meshes")) return;
    DracoFinds finds{root, document, compressed};
    json& meshes = document["meshes"];
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        json& primitives = meshes[i]["primitives"];
        for (std::size_t k = 0; k < primitives.size(); ++k) {
            const auto extensions = primitives[k].find("extensions");
            if (extensions != primitives[k].end() && extensions->contains(draco))
                take_primitive(finds, root / "meshes" / i / "primitives" / k, primitives[k]);
        }
    }
}

/// Bytes of a buffer from `offset` on.
Bytes bytes_of(const tinygltf::Model& model, const Place& place, std::size_t buffer,
               std::size_t offset, std::size_t length) {
    const std::vector<unsigned char>& bytes = model.buffers[buffer].data;
    if (offset + length > bytes.size()) // each is at most limits.bytes
        place.refuse(
            fmt::format("ends at byte {} of a buffer of {}", offset + length, bytes.size()),
            "mend byteOffset and byteLength");
    return Bytes(bytes).subspan(offset, length);
}

void decompress_views(const Compressed& compressed, tinygltf::Model& model, MemoryAccount& memory) {
    for (const CompressedView& view : compressed.views) {
        const Bytes stream = bytes_of(model, view.place, view.source, view.offset, view.length);
        const std::size_t size = view.layout.count * view.layout.stride;
        memory.keep({size, view.place.where(), "its elements", "split the asset"});
        std::vector<unsigned char> decoded(size);
        decode_meshopt(view.place, view.layout, stream, decoded);
        model.buffers[view.target].data = std::move(decoded);
    }
}

DracoPart part_of(const Place& root, const tinygltf::Model& model,
                  const CompressedAccessor& wanted) {
    const tinygltf::Accessor& accessor = model.accessors[wanted.accessor];
    const auto type = static_cast<std::uint32_t>(accessor.type);
    const auto component = static_cast<std::uint32_t>(accessor.componentType);
    DracoPart part{wanted.id,
                   accessor.count,
                   as_index(tinygltf::GetNumComponentsInType(type)),
                   accessor.componentType,
                   as_index(tinygltf::GetComponentSizeInBytes(component)),
                   root / "accessors" / wanted.accessor};
    const bool are_indices = part.components == 1 && part.component_type != 5126;
    if (part.id == DracoPart::indices && !are_indices)
        part.place.refuse("holds indices, but no scalar integers",
                          "use 5121, 5123 or 5125 and \"SCALAR\"");
    return part;
}

void decompress_meshes(const Place& root, const Compressed& compressed, tinygltf::Model& model,
                       MemoryAccount& memory) {
    std::vector<DracoMesh> meshes;
    std::uint64_t total = 0;
    for (const CompressedMesh& source : compressed.meshes) {
        const tinygltf::BufferView& view = model.bufferViews[source.view];
        DracoMesh mesh{bytes_of(model, root / "bufferViews" / source.view, as_index(view.buffer),
                                view.byteOffset, view.byteLength),
                       source.place,
                       {}};
        total += mesh.stream.size();
        for (const CompressedAccessor& wanted : source.accessors) {
            mesh.parts.push_back(part_of(root, model, wanted));
            total += mesh.parts.back().size(); // below 2^32 elements of 2^6 bytes
        }
        if (total > limits.bytes)
            source.place.refuse(
                fmt::format("brings what is compressed above {} bytes", limits.bytes),
                "split the asset");
        meshes.push_back(std::move(mesh));
    }
    decode_draco(meshes, memory);
    for (std::size_t i = 0; i < meshes.size(); ++i)
        for (std::size_t k = 0; k < meshes[i].parts.size(); ++k) {
            const CompressedAccessor& wanted = compressed.meshes[i].accessors[k];
            const auto view = as_index(model.accessors[wanted.accessor].bufferView);
            model.bufferViews[view].byteLength = meshes[i].parts[k].size();
            model.buffers[wanted.target].data = std::move(meshes[i].parts[k].bytes);
        }
}

} // namespace

Compressed take_compressed(const Place& root, json& document, bool has_chunk) {
    Compressed compressed;
    compressed.placeholders.resize(document.contains("buffers") ? document["buffers"].size() : 0);
    take_views(root, document, has_chunk, compressed);
    take_primitives(root, document, compressed);
    return compressed;
}

void decompress(const Place& root, const Compressed& compressed, tinygltf::Model& model,
                MemoryAccount& memory) {
    decompress_views(compressed, model, memory);
    decompress_meshes(root, compressed, model, memory);
}

} // namespace shadowproof::gltf
