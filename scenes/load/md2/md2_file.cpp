#include "scenes/load/md2/md2_file.h"

#include "scenes/error.h"
#include "scenes/limits.h"
#include "scenes/load/common/file_bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

namespace shadowproof::md2 {

namespace {

using Bytes = std::span<const unsigned char>;

constexpr std::uint32_t ident = 0x32504449; // "IDP2"
constexpr std::uint32_t known_version = 8;
constexpr std::size_t name_bytes = 64; // of a skin
constexpr std::size_t place_bytes = 4;
constexpr std::size_t triangle_bytes = 12;
constexpr std::size_t frame_name_at = 24; // behind scale and translation, three floats each
constexpr std::size_t frame_name_bytes = 16;
constexpr std::size_t vertices_at = frame_name_at + frame_name_bytes;
constexpr std::size_t vertex_bytes = 4; // x, y, z, index of a normal

template <class T>
T number_at(Bytes bytes, std::size_t offset) {
    T number{};
    std::memcpy(&number, bytes.data() + offset, sizeof number);
    return number;
}

/// As the file has it, 17 numbers.
struct Header {
    std::uint32_t ident, version;
    std::uint32_t skin_width, skin_height;
    std::uint32_t frame_bytes;
    std::uint32_t skins, vertices, places, triangles, commands, frames;
    std::uint32_t skins_at, places_at, triangles_at, frames_at, commands_at, end_at;
};
static_assert(sizeof(Header) == 68);

constexpr const char* export_again = "export the model again";

[[noreturn]] void refuse(const std::string& file, const std::string& what,
                         const std::string& remedy = export_again) {
    throw Error(file, what, remedy);
}

/// The bytes of a table that the header describes.
Bytes table(const std::string& file, Bytes bytes, const char* what, std::uint64_t offset,
            std::uint64_t count, std::uint64_t size) {
    if (offset > bytes.size() || count * size > bytes.size() - offset) // each below 2^32
        refuse(file,
               fmt::format("has {} {} from byte {} on, of {} bytes each, but ends at byte {}",
                           count, what, offset, size, bytes.size()),
               "restore the missing bytes, or export the model again");
    return bytes.subspan(offset, count * size);
}

/// Up to the first NUL.
std::string text_in(Bytes bytes) {
    std::string text;
    for (const unsigned char c : bytes) {
        if (c == 0) break;
        text += c >= ' ' && c <= '~' ? static_cast<char>(c) : '?';
    }
    return text;
}

Header read_header(const std::string& file, Bytes bytes) {
    if (bytes.size() < sizeof(Header))
        refuse(file, fmt::format("is no .md2: {} bytes are less than a header's {}", bytes.size(),
                                 sizeof(Header)));
    const auto header = number_at<Header>(bytes, 0);
    if (header.ident != ident)
        refuse(file, "is no .md2: it does not begin with IDP2", "name a Quake II model");
    if (header.version != known_version)
        refuse(file, fmt::format("has version {}, not {}", header.version, known_version),
               "convert it to a Quake II model");
    if (header.triangles == 0 || header.vertices == 0 || header.frames == 0)
        refuse(file, fmt::format("has {} triangles, {} vertices and {} frames, and needs one of "
                                 "each",
                                 header.triangles, header.vertices, header.frames));
    if (header.triangles > limits.triangles || header.vertices > limits.triangles)
        refuse(file, fmt::format("has more than {} triangles or vertices", limits.triangles),
               "split the model");
    if (header.frame_bytes < vertices_at + vertex_bytes * std::uint64_t{header.vertices})
        refuse(file, fmt::format("has frames of {} bytes, too short for {} vertices",
                                 header.frame_bytes, header.vertices));
    if (header.skin_width == 0 || header.skin_height == 0 || header.skin_width > 0xffff ||
        header.skin_height > 0xffff)
        refuse(file,
               fmt::format("has skins of {} by {} texels", header.skin_width, header.skin_height));
    return header;
}

std::vector<Triangle> read_triangles(const std::string& file, Bytes bytes, const Header& header) {
    std::vector<Triangle> triangles(header.triangles);
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            Corner& corner = triangles[i].corners[k];
            corner.vertex = number_at<std::uint16_t>(bytes, i * triangle_bytes + 2 * k);
            corner.place = number_at<std::uint16_t>(bytes, i * triangle_bytes + 6 + 2 * k);
            if (corner.vertex >= header.vertices || corner.place >= header.places)
                refuse(file,
                       fmt::format("triangle {} names vertex {} of {} and texture "
                                   "coordinates {} of {}",
                                   i, corner.vertex, header.vertices, corner.place, header.places));
        }
    return triangles;
}

} // namespace

Model read_model(const std::filesystem::path& path, MemoryAccount& memory) {
    Model model;
    model.file = path.string();
    const FileBytes all = read_bytes(path, Place(model.file), memory);
    const MemoryHold held = memory.hold({all.size(), model.file, "its bytes", "split the model"});
    const Bytes bytes(all);
    const Header header = read_header(model.file, bytes);
    const auto find = [&](const char* what, std::uint64_t offset, std::uint64_t count,
                          std::uint64_t size) {
        return table(model.file, bytes, what, offset, count, size);
    };
    const Bytes skins = find("skins", header.skins_at, header.skins, name_bytes);
    const Bytes places = find("texture coordinates", header.places_at, header.places, place_bytes);
    const Bytes triangles =
        find("triangles", header.triangles_at, header.triangles, triangle_bytes);
    const Bytes frames = find("frames", header.frames_at, header.frames, header.frame_bytes);
    // The vector of places takes up to three times its size while it grows.
    memory.keep({frames.size() + header.triangles * std::uint64_t{sizeof(Triangle)} +
                     3 * sizeof(glm::ivec2) * std::uint64_t{header.places},
                 model.file, "its frames and triangles", "split the model"});
    if (!skins.empty()) model.skin = text_in(skins.first(name_bytes));
    model.size = {static_cast<int>(header.skin_width), static_cast<int>(header.skin_height)};
    for (std::size_t i = 0; i < header.places; ++i)
        model.places.emplace_back(number_at<std::int16_t>(places, i * place_bytes),
                                  number_at<std::int16_t>(places, i * place_bytes + 2));
    model.triangles = read_triangles(model.file, triangles, header);
    model.vertex_count = header.vertices;
    model.frame_count = header.frames;
    model.frame_bytes = header.frame_bytes;
    model.bytes.assign(frames.begin(), frames.end());
    return model;
}

Frame read_frame(const Model& model, std::uint32_t frame) {
    const Bytes bytes =
        Bytes(model.bytes).subspan(std::size_t{frame} * model.frame_bytes, model.frame_bytes);
    Frame read{text_in(bytes.subspan(frame_name_at, frame_name_bytes)), {}};
    glm::dvec3 scale;
    glm::dvec3 translation;
    for (int k = 0; k < 3; ++k) {
        const auto at = static_cast<std::size_t>(k) * sizeof(float);
        scale[k] = number_at<float>(bytes, at);
        translation[k] = number_at<float>(bytes, at + 3 * sizeof(float));
        // A vertex's coordinates are 0 to 255 times the scale; they must fit a float.
        if (!(std::abs(scale[k]) < 0x1p100) || !(std::abs(translation[k]) < 0x1p100))
            refuse(model.file,
                   fmt::format("frame {} \"{}\" has the scale {} and the translation {}", frame,
                               read.name, scale[k], translation[k]),
                   "mend the frame");
    }
    read.positions.reserve(model.vertex_count);
    for (std::size_t i = 0; i < model.vertex_count; ++i) {
        const unsigned char* stored = bytes.data() + vertices_at + i * vertex_bytes;
        read.positions.push_back(scale * glm::dvec3(stored[0], stored[1], stored[2]) + translation);
    }
    return read;
}

} // namespace shadowproof::md2
