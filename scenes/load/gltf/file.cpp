#include "scenes/load/gltf/file.h"

#include "scenes/load/common/file_bytes.h"
#include "scenes/load/gltf/check.h"
#include "scenes/load/gltf/compressed.h"
#include "scenes/load/gltf/glb.h"
#include "scenes/load/gltf/memory.h"

#include <fmt/format.h>

#include <algorithm>

namespace shadowproof::gltf {

namespace {

using nlohmann::json;

/// Counts what the raw text holds, before anything is allocated for it.
JsonCounts scan_json(const Place& root, std::string_view text) {
    const JsonCounts counts = count_json(text, limits.json_depth);
    if (counts.too_deep_at)
        root.refuse(fmt::format("nests deeper than {} levels at byte {}", limits.json_depth,
                                *counts.too_deep_at),
                    "flatten the JSON");
    if (counts.values > limits.json_values)
        root.refuse(fmt::format("holds more than {} JSON values", limits.json_values),
                    "move the bulk into buffers");
    return counts;
}

/// `counts` becomes the text's.
json parse_json(const Place& root, std::string_view text, MemoryAccount& memory,
                JsonCounts& counts) {
    if (text.size() > limits.json_bytes)
        root.refuse(
            fmt::format("has {} bytes of JSON, more than {}", text.size(), limits.json_bytes),
            "move the bulk into .bin buffers");
    counts = scan_json(root, text);
    memory.keep({json_bytes(counts), root.where(), "its JSON", "move the bulk into buffers"});
    // The parser's own message repeats what it read last, which may be all of the file.
    try {
        return json::parse(text);
    } catch (const json::parse_error& error) {
        root.refuse(fmt::format("is not JSON at byte {}", error.byte), "export the asset again");
    } catch (const json::out_of_range&) {
        root.refuse("holds a number beyond every double", "export the asset again");
    }
}

/// The buffers that are not data URIs, by index, for tinygltf's callbacks.
struct BufferFiles {
    struct Buffer {
        std::string uri; ///< empty: the GLB chunk
        std::uint64_t length = 0;
        Place place;
        bool is_placeholder = false; ///< nothing is read
    };
    std::filesystem::path folder;
    std::optional<std::span<const unsigned char>> binary;
    std::vector<Buffer> buffers;
    const MemoryAccount& memory;
};

void require_length(std::uint64_t available, const BufferFiles::Buffer& buffer) {
    if (available < buffer.length)
        (buffer.place / "byteLength")
            .refuse(fmt::format("is {} but the buffer has {} bytes", buffer.length, available),
                    "restore the missing bytes");
}

/// Exactly byteLength bytes, because tinygltf takes neither more nor fewer.
FileBytes read_buffer(const BufferFiles& files, const BufferFiles::Buffer& buffer) {
    if (buffer.is_placeholder) return FileBytes(buffer.length);
    if (buffer.uri.empty()) {
        require_length(files.binary->size(), buffer);
        const auto first = files.binary->first(buffer.length);
        return {first.begin(), first.end()};
    }
    const Place place = buffer.place / "uri";
    FileBytes bytes = read_bytes(resolve_uri(files.folder, buffer.uri, place), place, files.memory,
                                 buffer.length);
    require_length(bytes.size(), buffer);
    return bytes;
}

/// The data URI with a media type that tinygltf knows, and no more bytes than it wants.
std::string trimmed_data_uri(const std::string& uri, const BufferFiles::Buffer& buffer) {
    const std::string_view digits = base64_digits(uri, buffer.place / "uri");
    require_length(digits.size() * 3 / 4, buffer);
    return fmt::format("data:application/octet-stream;base64,{}",
                       digits.substr(0, (buffer.length * 4 + 2) / 3));
}

/// Replaces the buffers' URIs in the JSON by "0", "1" and so on, for which tinygltf calls
/// read_buffer. By itself tinygltf reads whatever they name, and replaces each + of a file's name
/// by a space.
void take_buffers(const Place& root, json& document, const std::vector<bool>& placeholders,
                  BufferFiles& files) {
    const std::size_t count = document.contains("buffers") ? document["buffers"].size() : 0;
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < count; ++i) {
        json& item = document["buffers"][i];
        BufferFiles::Buffer buffer{item.value("uri", ""), item["byteLength"], root / "buffers" / i,
                                   placeholders[i]};
        total += buffer.length;
        if (buffer.length > limits.bytes || total > limits.bytes)
            (buffer.place / "byteLength")
                .refuse(fmt::format("brings the buffers above {} bytes", limits.bytes),
                        "split the asset");
        if (!item.contains("uri") && !buffer.is_placeholder && (i > 0 || !files.binary))
            buffer.place.refuse("has no uri and there is no GLB chunk for it", "add the uri");
        if (item.contains("uri") && buffer.uri.empty())
            (buffer.place / "uri").refuse("is empty", "name a file");
        const bool embedded = buffer.uri.starts_with("data:");
        item["uri"] = embedded ? trimmed_data_uri(buffer.uri, buffer) : std::to_string(i);
        if (embedded) buffer.uri.clear();
        files.buffers.push_back(std::move(buffer));
    }
}

/// The members that lighting reads, copied or (where tinygltf must not see them) moved.
json take_look(json& document) {
    json look = json::object();
    for (const char* key : {"materials", "bufferViews", "extras"})
        if (document.contains(key)) look[key] = document[key];
    for (const char* key : {"textures", "samplers", "images"})
        if (document.contains(key)) {
            look[key] = std::move(document[key]);
            document.erase(key);
        }
    return look;
}

/// Removes what tinygltf would refuse or drop although glTF allows it.
void make_digestible(json& document) {
    if (document.contains("cameras"))
        for (json& camera : document["cameras"])
            if (camera["type"] == "orthographic" && !camera.contains("orthographic"))
                camera["orthographic"] = {{"xmag", 0}, {"ymag", 0}, {"zfar", 1}, {"znear", 0}};
    if (document.contains("animations"))
        for (json& animation : document["animations"])
            for (json& channel : animation["channels"])
                if (!channel["target"].contains("node")) channel["target"]["node"] = -1;
}

tinygltf::FsCallbacks callbacks(BufferFiles& files) {
    return {[](const std::string&, void*) { return true; },
            [](const std::string& name, void*) { return name; },
            [](FileBytes* bytes, std::string*, const std::string& name, void* user) {
                const auto& all = *static_cast<const BufferFiles*>(user);
                *bytes = read_buffer(all, all.buffers.at(std::stoul(name)));
                return true;
            },
            nullptr, &files};
}

/// Where tinygltf stopped: it appends element after element to one array after the other.
Place stopped_at(const Place& root, const json& document, const tinygltf::Model& model) {
    const std::pair<const char*, std::size_t> read[] = {
        {"buffers", model.buffers.size()},     {"bufferViews", model.bufferViews.size()},
        {"accessors", model.accessors.size()}, {"meshes", model.meshes.size()},
        {"nodes", model.nodes.size()},         {"scenes", model.scenes.size()},
        {"materials", model.materials.size()}, {"animations", model.animations.size()},
        {"skins", model.skins.size()},         {"cameras", model.cameras.size()}};
    for (const auto& [array, count] : read)
        if (document.contains(array) && count < document[array].size()) return root / array / count;
    return root / "extensions" / "KHR_lights_punctual" / "lights" / model.lights.size();
}

tinygltf::Model parse_model(const Place& root, const json& document, BufferFiles& files) {
    tinygltf::TinyGLTF loader;
    loader.SetFsCallbacks(callbacks(files));
    tinygltf::Model model;
    std::string errors;
    std::string warnings;
    const std::string text = document.dump();
    if (!loader.LoadASCIIFromString(&model, &errors, &warnings, text.data(),
                                    static_cast<unsigned>(text.size()), ""))
        stopped_at(root, document, model)
            .refuse("is refused by tinygltf: " +
                        errors.substr(0, errors.find_last_not_of('\n') + 1),
                    "export the asset again");
    return model;
}

} // namespace

Document read_document(const std::filesystem::path& file, const MemoryBudget& budget) {
    Document document;
    document.memory = std::make_shared<MemoryAccount>(budget);
    MemoryAccount& memory = *document.memory;
    document.file = file.string();
    document.folder = file.parent_path();
    const Place root = document.root();
    const FileBytes bytes = read_bytes(file, root, memory);
    const MemoryHold held = memory.hold({bytes.size(), root.where(), "its bytes", "split it"});
    const Chunks chunks = split_chunks(root, bytes);
    JsonCounts counts;
    json parsed = parse_json(root, chunks.json, memory, counts);
    check_json(root, parsed);
    const Compressed compressed = take_compressed(root, parsed, chunks.binary.has_value());
    BufferFiles files{document.folder, chunks.binary, {}, memory};
    // Data URIs exist once more in the trimmed copy, in the JSON that is written for tinygltf, and
    // (twice, while they grow) in what it reads of it.
    const MemoryHold passing = memory.hold({4 * counts.bytes + json_bytes(counts), root.where(),
                                            "reading its JSON", "move the bulk into .bin buffers"});
    memory.keep({model_bytes(parsed, counts), root.where(), "its nodes, meshes and accessors",
                 "split the asset"});
    take_buffers(root, parsed, compressed.placeholders, files);
    std::uint64_t buffers = 0;
    for (const BufferFiles::Buffer& buffer : files.buffers) buffers += buffer.length;
    memory.keep({buffers, (root / "buffers").where(), "its buffers", "split the asset"});
    // tinygltf reads one buffer, and copies it.
    memory.require({buffers, (root / "buffers").where(), "its buffers", "split the asset"});
    document.look = take_look(parsed);
    make_digestible(parsed);
    document.model = parse_model(root, parsed, files);
    decompress(root, compressed, document.model, memory);
    document.extras = parsed.value("extras", json());
    return document;
}

} // namespace shadowproof::gltf
