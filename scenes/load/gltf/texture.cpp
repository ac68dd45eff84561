#include "scenes/load/gltf/texture.h"

#include "scenes/load/common/file_bytes.h"
#include "scenes/load/picture/picture.h"

#include <fmt/format.h>

namespace shadowproof::gltf {

namespace {

using nlohmann::json;

// Numbers of the glTF 2.0 specification.
constexpr int filter_nearest = 9728;
constexpr int filter_nearest_mipmap_nearest = 9984; // the first of four with mipmaps,
constexpr int filter_linear_mipmap_linear = 9987;   // and the last
constexpr int wrap_clamp_to_edge = 33071;
constexpr int wrap_mirrored_repeat = 33648;
constexpr int wrap_repeat = 10497;

FileBytes bytes_in_view(const Document& document, std::size_t index) {
    const tinygltf::BufferView& view = document.model.bufferViews[index];
    const FileBytes& buffer = document.model.buffers[as_index(view.buffer)].data;
    if (view.byteOffset + view.byteLength > buffer.size()) // each is at most limits.bytes
        (document.root() / "bufferViews" / index)
            .refuse(fmt::format("ends at byte {} of a buffer of {}",
                                view.byteOffset + view.byteLength, buffer.size()),
                    "mend byteOffset and byteLength");
    const auto first = buffer.begin() + static_cast<std::ptrdiff_t>(view.byteOffset);
    document.memory->require({view.byteLength, (document.root() / "bufferViews" / index).where(),
                              "its bytes", "mend byteLength"});
    return {first, first + static_cast<std::ptrdiff_t>(view.byteLength)};
}

FileBytes bytes_in_uri(const Document& document, const std::string& uri, const Place& place) {
    if (!uri.starts_with("data:"))
        return read_bytes(resolve_uri(document.folder, uri, place), place, *document.memory);
    document.memory->require({3 * uri.size(), place.where(), "decoding it", "write a file"});
    FileBytes bytes;
    std::string type;
    const std::string known = // as tinygltf knows it
        fmt::format("data:application/octet-stream;base64,{}", base64_digits(uri, place));
    if (!tinygltf::DecodeDataURI(&bytes, type, known, 0, false))
        place.refuse("is an empty data URI", "embed the picture");
    return bytes;
}

FileBytes image_bytes(const Document& document, const json& source, std::size_t image) {
    const Place place = document.root() / "images" / image;
    if (source.contains("bufferView")) return bytes_in_view(document, source["bufferView"]);
    if (!source.contains("uri"))
        place.refuse("has neither uri nor bufferView", "say where the picture is");
    return bytes_in_uri(document, source["uri"], place / "uri");
}

Wrap wrap_mode(const Place& place, int mode) {
    if (mode == wrap_repeat) return Wrap::repeat;
    if (mode == wrap_mirrored_repeat) return Wrap::mirrored_repeat;
    if (mode == wrap_clamp_to_edge) return Wrap::clamp_to_edge;
    place.refuse(fmt::format("{} is no wrap mode", mode), "use 10497, 33071 or 33648");
}

} // namespace

void TextureReader::set_sampler(std::size_t sampler, TextureImage& texture) {
    const json& source = look_["samplers"][sampler];
    const Place place = document_.root() / "samplers" / sampler;
    texture.wrap_s = wrap_mode(place / "wrapS", source.value("wrapS", wrap_repeat));
    texture.wrap_t = wrap_mode(place / "wrapT", source.value("wrapT", wrap_repeat));
    const int smaller = source.value("minFilter", 0);
    texture.mipmaps =
        smaller >= filter_nearest_mipmap_nearest && smaller <= filter_linear_mipmap_linear;
    texture.nearest = source.value("magFilter", 0) == filter_nearest;
    nearest_ = nearest_ || texture.nearest;
}

/// Sets all of `read` but its texels, each of which takes so many bytes and is kept.
Picture TextureReader::picture_of(const Place& reference, std::size_t texture, TextureImage& read,
                                  std::uint64_t bytes_of_texel) {
    const json& source = look_["textures"][texture];
    const Place place = document_.root() / "textures" / texture;
    if (!source.contains("source"))
        reference.refuse(fmt::format("names texture {}, which has no PNG or JPEG image", texture),
                         "give it a source");
    const std::size_t image = source["source"];
    read.name = place.pointer();
    if (source.contains("sampler")) set_sampler(source["sampler"], read);
    const std::string where = (document_.root() / "images" / image).where();
    MemoryAccount& memory = *document_.memory;
    const FileBytes bytes = image_bytes(document_, look_["images"][image], image);
    const MemoryHold held = memory.hold({bytes.size(), where, "its bytes", "scale it down"});
    Picture picture = decode_picture(bytes, where,
                                     {.memory = memory,
                                      .most_pixels = limits.texels - texels_,
                                      .bytes_made_of_pixel = bytes_of_texel});
    read.bits = picture.bits;
    const std::uint64_t texels = std::uint64_t{static_cast<std::uint32_t>(picture.width)} *
                                 static_cast<std::uint32_t>(picture.height);
    texels_ += texels;
    memory.keep({texels * bytes_of_texel, where, "its texels", "scale it down"});
    return picture;
}

TextureImage TextureReader::decode(const Place& reference, std::size_t texture, Encoding encoding) {
    TextureImage read;
    read.texels = texels_of(picture_of(reference, texture, read, sizeof(glm::vec4)), encoding);
    return read;
}

AlphaMask TextureReader::decode_alpha(const Place& reference, std::size_t texture) {
    TextureImage read;
    const Picture picture = picture_of(reference, texture, read, sizeof(float));
    return {.name = read.name,
            .alpha = alpha_of(picture),
            .wrap_s = read.wrap_s,
            .wrap_t = read.wrap_t,
            .nearest = read.nearest};
}

std::uint32_t TextureReader::read(const Place& reference, std::size_t texture, Encoding encoding) {
    const auto known = read_.find({texture, encoding});
    if (known != read_.end()) return known->second;
    textures_.push_back(decode(reference, texture, encoding));
    const auto index = static_cast<std::uint32_t>(textures_.size() - 1);
    read_.emplace(std::pair{texture, encoding}, index);
    return index;
}

} // namespace shadowproof::gltf
